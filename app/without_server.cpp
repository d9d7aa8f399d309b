// What a build without the HTTP library says where one with it serves.
#include "app/page_server.h"
#include "core/error.h"

namespace nacre {

void hold_signals() {}

void serve_page(const ServedPage& /*served*/, int /*port*/,
                const std::function<void(const std::string& address)>& /*ready*/) {
  throw Error(ErrorCode::Unsupported,
              "found a build without cpp-httplib, which serves pages; expected one with it, or -o "
              "PAGE.html");
}

}  // namespace nacre
