#include "app/page_server.h"

#include <fmt/core.h>
#include <httplib.h>
#include <pthread.h>
#include <sys/socket.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <csignal>
#include <ctime>
#include <mutex>
#include <stop_token>
#include <thread>

#include "core/error.h"

namespace nacre {
namespace {

constexpr const char* kHost = "127.0.0.1";

// On this machine nothing takes long to arrive; an end waits for connections that ask for nothing.
constexpr time_t kIdleSeconds = 1;

/// The library's own would let two servers share a port: requests would go to either.
void set_socket_options(int socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

/// Stops the server when a signal comes; looks now and then whether it has stopped by itself.
void stop_on_signal(const std::stop_token& done, httplib::Server& server) {
  const sigset_t signals = ending_signals();
  const timespec wait{0, 200'000'000};
  bool told = false;
  while (!done.stop_requested()) {
    told = told || sigtimedwait(&signals, nullptr, &wait) > 0;
    if (!told) continue;
    // One that does not listen yet would not be stopped, and listen for ever.
    if (server.is_running()) return server.stop();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Whether the request names this host, by number or as localhost, whatever the port.
bool is_for_loopback(const httplib::Request& request) {
  const std::string host = request.get_header_value("Host");
  const std::string name = host.substr(0, host.rfind(':'));
  return name == kHost || name == "localhost";
}

void set_content(httplib::Response& response, const std::vector<std::byte>& bytes,
                 const char* type = "model/gltf-binary") {
  response.set_content(reinterpret_cast<const char*>(bytes.data()), bytes.size(), type);
}

/// Answers with a line of text in place of what was asked for.
void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why, "text/plain");
}

/// A level's emission as the request gives it; 0 if it is none.
double emission_of(const httplib::Request& request) {
  const std::string text = request.get_param_value("emission");
  double emission = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), emission);
  const bool fits = error == std::errc() && end == text.data() + text.size();
  return fits && emission > 0.0 && emission <= 1.0 ? emission : 0.0;
}

/// Shells under way: one draft and one other, so that a draft waits for no simplification.
struct LevelLocks {
  std::mutex draft;
  std::mutex whole;
};

void answer_level(const ServedPage& served, LevelLocks& locks, const httplib::Request& request,
                  httplib::Response& response) {
  const LevelRequest level{emission_of(request), request.has_param("draft")};
  if (level.emission == 0.0) {
    return refuse(response, 400, "found no emission, expected one above 0 and up to 1");
  }
  const std::lock_guard lock(level.draft ? locks.draft : locks.whole);
  try {
    const ServedLevel made = served.level(level);
    set_content(response, made.set);
    if (made.is_draft) response.set_header("Nacre-Draft", "yes");
  } catch (const std::exception& error) {
    refuse(response, 500, error.what());
  }
}

/// Pictures drawn or waiting for it at once: a page asks for one after the other. More would keep
/// all else from being answered, and the server from ending.
constexpr int kMostPictures = 3;

void answer_picture(const ServedPage& served, std::atomic<int>& under_way,
                    const httplib::Request& request, httplib::Response& response) {
  struct Place {
    std::atomic<int>& taken;
    int number = ++taken;
    ~Place() { --taken; }
  } place{under_way};
  if (place.number > kMostPictures) {
    return refuse(
        response, 503,
        fmt::format("found {} pictures under way, expected to be asked later", kMostPictures));
  }
  try {
    set_content(response, served.picture({request.params.begin(), request.params.end()}),
                "application/octet-stream");
  } catch (const std::exception& error) {
    refuse(response, 400, error.what());
  }
}

/// Whether a page of somebody else's asks for what it could not read, but would keep this machine
/// busy with. That it leads to the page itself is its right.
bool is_foreign(const httplib::Request& request) {
  return request.path != "/" && request.get_header_value("Sec-Fetch-Site") == "cross-site";
}

void add_answers(httplib::Server& server, const ServedPage& served, LevelLocks& locks,
                 std::atomic<int>& pictures) {
  using Request = httplib::Request;
  using Response = httplib::Response;
  server.set_default_headers(
      {{"Cache-Control", "no-store"}, {"X-Content-Type-Options", "nosniff"}});
  server.set_pre_routing_handler([](const Request& request, Response& response) {
    if (is_for_loopback(request) && !is_foreign(request))
      return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get("/", [&served](const Request&, Response& response) {
    response.set_content(served.html, "text/html");
  });
  server.Get("/set.glb",
             [&served](const Request&, Response& response) { set_content(response, served.set); });
  if (served.picture) {
    server.Get("/picture", [&](const Request& request, Response& response) {
      answer_picture(served, pictures, request, response);
    });
  }
  if (!served.level) return;
  server.Post("/level", [&](const Request& request, Response& response) {
    answer_level(served, locks, request, response);
  });
}

}  // namespace

void hold_signals() {
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

void serve_page(const ServedPage& served, int port,
                const std::function<void(const std::string& address)>& ready) {
  hold_signals();
  httplib::Server server;
  LevelLocks locks;
  std::atomic<int> pictures = 0;
  add_answers(server, served, locks, pictures);
  server.set_socket_options(set_socket_options);
  server.set_tcp_nodelay(true);  // a picture waits for no more to send
  server.set_keep_alive_timeout(kIdleSeconds);
  server.set_read_timeout(kIdleSeconds);
  const int bound = port == 0                          ? server.bind_to_any_port(kHost)
                    : server.bind_to_port(kHost, port) ? port
                                                       : -1;
  if (bound <= 0) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("port {}: found it taken, expected a free one", port));
  }
  ready(fmt::format("http://{}:{}/", kHost, bound));
  const std::jthread stopper(
      [&server](const std::stop_token& done) { stop_on_signal(done, server); });
  server.listen_after_bind();
}

}  // namespace nacre
