#pragma once

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>

namespace nacre::testing {

/// Damages files at random, from a seed.
class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}

  /// A copy with one to four changes, most of them near the start, where headers are.
  std::string of(std::string bytes) {
    if (below(4) == 0) return bytes.substr(0, below(bytes.size()));
    const std::size_t changes = 1 + below(4);
    for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
      const std::size_t end =
          below(3) == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 600);
      change(bytes, below(end));
    }
    return bytes;
  }

 private:
  std::size_t below(std::size_t limit) { return random_() % std::max<std::size_t>(limit, 1); }

  void change(std::string& bytes, std::size_t at) {
    constexpr std::string_view text = "0123456789 \n=:.-xe%(),";
    switch (below(5)) {
      case 0: bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8))); break;
      case 1: bytes[at] = text[below(text.size())]; break;
      case 2: bytes.erase(at, 1 + below(20)); break;
      case 3: bytes.insert(at, std::string(1 + below(12), text[below(10)])); break;
      default: bytes[at] = static_cast<char>(random_()); break;
    }
  }

  std::mt19937 random_;
};

}  // namespace nacre::testing
