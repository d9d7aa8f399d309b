// What the page's server answers, asked by hand over a socket: what it gives away, what it refuses,
// and how it ends. A program of its own, since signals reach whole programs.
#include "app/page_server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <future>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "tests/support/expect_error.h"

namespace nacre {
namespace {

using testing::expect_error;

struct Answer {
  int status = 0;
  std::string head;
  std::string body;
};

/// A connection to 127.0.0.1.
class Connection {
 public:
  explicit Connection(int port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("no connection");
    }
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection() { close(socket_); }

  void send_text(const std::string& text) const {
    ASSERT_EQ(send(socket_, text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }

  /// All that comes until the other end closes.
  Answer receive() const {
    std::string text;
    std::vector<char> part(4096);
    for (ssize_t n = 0; (n = recv(socket_, part.data(), part.size(), 0)) > 0;) {
      text.append(part.data(), static_cast<std::size_t>(n));
    }
    Answer answer;
    const std::size_t end = text.find("\r\n\r\n");
    if (end == std::string::npos) return answer;
    answer.head = text.substr(0, end);
    answer.body = text.substr(end + 4);
    std::istringstream(answer.head.substr(answer.head.find(' '))) >> answer.status;
    return answer;
  }

 private:
  int socket_;
};

/// A server of a page, a set and levels, until the signal that `end` sends.
class PageServer : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!NACRE_HAS_SERVER) GTEST_SKIP() << "built without cpp-httplib";
    served_.html = "<p>page</p>";
    served_.set = {std::byte{'s'}, std::byte{'e'}, std::byte{'t'}};
  }

  void TearDown() override {
    if (running_.valid()) end(SIGTERM);
  }

  void start() {
    hold_signals();
    std::promise<std::string> ready;
    running_ = std::async(std::launch::async, [&] {
      serve_page(served_, 0, [&](const std::string& address) { ready.set_value(address); });
    });
    const std::string address = ready.get_future().get();
    EXPECT_EQ(address.rfind("http://127.0.0.1:", 0), 0u) << address;
    port_ = std::stoi(address.substr(17));
  }

  /// Seconds until it has ended.
  double end(int signal) {
    const auto start = std::chrono::steady_clock::now();
    kill(getpid(), signal);
    running_.get();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  /// The answer to a request with that first line, of that host ("": none is named).
  Answer ask(const std::string& line, const std::string& host = "127.0.0.1") const {
    const Connection connection(port_);
    connection.send_text(line + " HTTP/1.1\r\n" + (host.empty() ? "" : "Host: " + host + "\r\n") +
                         "Content-Length: 0\r\nConnection: close\r\n\r\n");
    return connection.receive();
  }

  ServedPage served_;
  int port_ = 0;
  std::future<void> running_;
};

TEST_F(PageServer, GivesThePageAndTheSetAndNothingElse) {
  start();
  EXPECT_EQ(ask("GET /").body, "<p>page</p>");
  EXPECT_EQ(ask("GET /set.glb").body, "set");
  EXPECT_NE(ask("GET /").head.find("X-Content-Type-Options: nosniff"), std::string::npos);
  for (const char* path :
       {"/etc/passwd", "//etc/passwd", "/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd",
        "/..%2f..%2fetc%2fpasswd", "/set.glb/../../etc/passwd", "/set.glb%00", "/.",
        "/CMakeLists.txt", "/index.html", "file:///etc/passwd"}) {
    EXPECT_GE(ask(std::string("GET ") + path).status, 400) << path;
  }
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH"}) {
    EXPECT_EQ(ask(std::string(method) + " /set.glb").status, 404) << method;
  }
}

// A page of another site that has its own name point to this machine is not answered.
TEST_F(PageServer, AnswersOnlyThoseWhoNameThisMachine) {
  start();
  const std::string port = ":" + std::to_string(port_);
  for (const std::string host : {"127.0.0.1", "localhost"}) {
    EXPECT_EQ(ask("GET /set.glb", host).status, 200) << host;
    EXPECT_EQ(ask("GET /set.glb", host + port).status, 200) << host;
  }
  for (const std::string host : {"", "elsewhere.example", "127.0.0.1.elsewhere.example",
                                 "localhost.elsewhere.example", "0.0.0.0", "127.0.0.2"}) {
    EXPECT_EQ(ask("GET /set.glb", host).status, 403) << host;
  }
}

TEST_F(PageServer, ListensOnTheLoopbackInterfaceAlone) {
  start();
  std::ostringstream port;
  port << ":" << std::uppercase << std::hex;
  port.width(4);
  port.fill('0');
  port << port_;
  std::size_t found = 0;
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream file(table);
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string number, local, remote, state;
      words >> number >> local >> remote >> state;
      const bool is_listening = state == "0A";
      if (!is_listening || local.substr(local.find(':')) != port.str()) continue;
      ++found;
      EXPECT_EQ(local, "0100007F" + port.str());
    }
  }
  if (!std::ifstream("/proc/net/tcp")) GTEST_SKIP() << "no /proc/net/tcp here";
  EXPECT_EQ(found, 1u);
}

TEST_F(PageServer, DrawsPicturesAsTheyAreAskedFor) {
  served_.picture = [](const PictureRequest& request) {
    if (request.empty()) throw Error(ErrorCode::BadArgument, "picture: found no flags");
    std::vector<std::byte> text;
    for (const auto& [name, value] : request) {
      for (const char c : name + "=" + value + ";") text.push_back(static_cast<std::byte>(c));
    }
    return text;
  };
  start();
  const Answer drawn = ask("GET /picture?azimuth=-30&slab=-5%2C5");
  EXPECT_EQ(drawn.status, 200);
  EXPECT_EQ(drawn.body, "azimuth=-30;slab=-5,5;");
  const Answer refused = ask("GET /picture");
  EXPECT_EQ(refused.status, 400);
  EXPECT_EQ(refused.body, "picture: found no flags");
  EXPECT_EQ(ask("GET /picture?azimuth=1", "elsewhere.example").status, 403);
}

TEST_F(PageServer, AnswersNoPageOfSomebodyElses) {
  start();
  const auto status = [&](const std::string& path, const std::string& site) {
    const Connection connection(port_);
    connection.send_text("GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\nSec-Fetch-Site: " + site +
                         "\r\nContent-Length: 0\r\nConnection: close\r\n\r\n");
    return connection.receive().status;
  };
  EXPECT_EQ(status("/set.glb", "cross-site"), 403);
  EXPECT_EQ(status("/set.glb", "same-origin"), 200);
  EXPECT_EQ(status("/", "cross-site"), 200);  // a link leads to it
}

TEST_F(PageServer, RefusesPicturesThatWouldQueue) {
  std::promise<void> go;
  const std::shared_future<void> told = go.get_future().share();
  std::atomic<int> drawn = 0;
  served_.picture = [&](const PictureRequest&) {
    ++drawn;
    told.wait();
    return std::vector<std::byte>{std::byte{'p'}};
  };
  start();
  std::vector<std::future<Answer>> first;
  for (int i = 0; i < 3; ++i) {
    first.push_back(std::async(std::launch::async, [&] { return ask("GET /picture"); }));
  }
  while (drawn < 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Answer refused = ask("GET /picture");
  EXPECT_EQ(refused.status, 503);
  EXPECT_EQ(refused.body, "found 3 pictures under way, expected to be asked later");
  go.set_value();
  for (std::future<Answer>& answer : first) EXPECT_EQ(answer.get().body, "p");
  EXPECT_EQ(ask("GET /picture").status, 200);
}

TEST_F(PageServer, DrawsNoPicturesUnlessItCan) {
  start();
  EXPECT_EQ(ask("GET /picture?azimuth=1").status, 404);
}

TEST_F(PageServer, MakesLevelsAsTheyAreAskedFor) {
  std::vector<LevelRequest> asked;
  served_.level = [&](const LevelRequest& request) {
    asked.push_back(request);
    return ServedLevel{{std::byte{'k'}}, request.draft};
  };
  start();
  const Answer whole = ask("POST /level?emission=0.25");
  EXPECT_EQ(whole.status, 200);
  EXPECT_EQ(whole.body, "k");
  EXPECT_EQ(whole.head.find("Nacre-Draft"), std::string::npos);
  EXPECT_NE(ask("POST /level?emission=1&draft").head.find("Nacre-Draft: yes"), std::string::npos);
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_EQ(asked[0].emission, 0.25);
  EXPECT_FALSE(asked[0].draft);
  EXPECT_EQ(asked[1].emission, 1.0);
  EXPECT_TRUE(asked[1].draft);
}

TEST_F(PageServer, ADraftWaitsForNoOtherShell) {
  std::promise<void> finish;
  served_.level = [&, finished = finish.get_future().share()](const LevelRequest& request) {
    if (!request.draft) finished.wait();
    return ServedLevel{};
  };
  start();
  std::future<Answer> whole =
      std::async(std::launch::async, [&] { return ask("POST /level?emission=0.25"); });
  EXPECT_EQ(ask("POST /level?emission=0.5&draft").status, 200);
  finish.set_value();
  EXPECT_EQ(whole.get().status, 200);
}

TEST_F(PageServer, BadRequestsGetALineAndEndNothing) {
  served_.level = [](const LevelRequest&) -> ServedLevel {
    throw Error(ErrorCode::BadArgument, "levels: found none");
  };
  start();
  for (const char* emission : {"", "x", "0", "-0.5", "1.01", "nan", "inf", "1e999", "0.5x", " 0.5",
                               "0.5,0.6", "%00", "0x1"}) {
    const Answer answer = ask(std::string("POST /level?emission=") + emission);
    EXPECT_EQ(answer.status, 400) << emission;
  }
  EXPECT_EQ(ask("POST /level?emission=7").body,
            "found no emission, expected one above 0 and up to 1");
  const Answer failed = ask("POST /level?emission=0.5");
  EXPECT_EQ(failed.status, 500);
  EXPECT_EQ(failed.body, "levels: found none");
  EXPECT_EQ(ask("GET /level?emission=0.5").status, 404);
  EXPECT_GE(ask("GET /" + std::string(20'000, 'a')).status, 400);
  const Connection noise(port_);
  noise.send_text("\x16\x03\x01 no HTTP at all\r\n\r\n");
  EXPECT_EQ(ask("GET /set.glb").status, 200);
}

TEST_F(PageServer, WithoutAVolumeThereAreNoLevels) {
  start();
  EXPECT_EQ(ask("POST /level?emission=0.5").status, 404);
}

// Also while a browser holds a connection that asks for nothing.
TEST_F(PageServer, EndsSoonWhenItIsTold) {
  for (const int signal : {SIGINT, SIGTERM}) {
    start();
    const Connection idle(port_);
    idle.send_text("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_LT(end(signal), 3.0) << signal;
    EXPECT_THROW(Connection{port_}, std::runtime_error) << "still answering";
  }
}

TEST_F(PageServer, EndsWhenItIsToldBeforeItListens) {
  hold_signals();
  for (int i = 0; i < 20; ++i) {
    std::future<void> running = std::async(std::launch::async, [&] {
      serve_page(served_, 0, [](const std::string&) { kill(getpid(), SIGTERM); });
    });
    ASSERT_EQ(running.wait_for(std::chrono::seconds(30)), std::future_status::ready);
    running.get();
  }
}

TEST_F(PageServer, APortThatIsTakenIsSaidToBe) {
  start();
  expect_error(ErrorCode::Unsupported, "port " + std::to_string(port_) + ": found it taken",
               [&] { serve_page(served_, port_, [](const std::string&) {}); });
}

}  // namespace
}  // namespace nacre
