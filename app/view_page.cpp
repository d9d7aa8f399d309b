#include "app/view_page.h"

#include <fmt/core.h>

#include <cstdint>

#include "core/error.h"
#include "viewer/page.h"

namespace nacre {
namespace {

/// RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U;
    };
    const std::uint32_t three = at(0) << 16U | at(1) << 8U | at(2);
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[three >> (18U - 6U * k) & 63U];
    }
  }
  return text;
}

std::string page_with(const std::string& set) {
  std::string page = viewer_page();
  const std::string_view mark = viewer_set_mark();
  return page.replace(page.find(mark), mark.size(), set);
}

}  // namespace

bool is_page_name(const std::filesystem::path& path) { return path.extension() == ".html"; }

void require_page(std::string_view output) {
  if (!viewer_page().empty()) return;
  throw Error(ErrorCode::Unsupported,
              fmt::format("{}: found a nacre built without the viewer's page, expected one built "
                          "where Node 18 or later and npm are",
                          output));
}

std::string page_with_set(std::span<const std::byte> set) { return page_with(base64(set)); }

std::string page_that_fetches(bool live) {
  return page_with(live ? "live:set.glb" : "fetch:set.glb");
}

}  // namespace nacre
