#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace nacre {

/// XXH64 of some bytes (Y. Collet, "xxHash fast digest algorithm", specification 0.1.1), the same
/// on every machine: words are read as little-endian.
///
/// It finds damage and tells volumes apart; it is no defence against a forger.
std::uint64_t xxh64(std::span<const std::byte> bytes, std::uint64_t seed = 0) noexcept;

/// Sixteen lower-case hexadecimal digits: JSON's numbers do not hold 64 bits everywhere.
std::string checksum_text(std::uint64_t checksum);

/// The reverse of `checksum_text`.
/// @return  false, and `checksum` as it was, unless the text is sixteen hexadecimal digits
bool parse_checksum(std::string_view text, std::uint64_t& checksum) noexcept;

}  // namespace nacre
