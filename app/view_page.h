#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace nacre {

/// Whether a name is one of a page: it ends in .html.
bool is_page_name(const std::filesystem::path& path);

/// @throws Error  Unsupported, naming `output`, if this build has no page
void require_page(std::string_view output);

/// The viewer's page with a shell file's bytes in it: opens from disk, needs nothing else.
/// @pre  `require_page` does not throw
std::string page_with_set(std::span<const std::byte> set);

/// The viewer's page that fetches its set from the server it came from.
/// @param live  whether that server makes shells of new levels
/// @pre  `require_page` does not throw
std::string page_that_fetches(bool live);

}  // namespace nacre
