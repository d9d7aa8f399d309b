#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::testing {

/// A new folder for a test's files, removed with all it holds.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::random_device random;
    path_ = std::filesystem::temp_directory_path() /
            ("nacre_test_" + std::to_string(random()) + std::to_string(random()));
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a file of these bytes; returns its path.
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    // A new file: some file systems wait for the disk where an old one is written over.
    std::filesystem::remove(path_ / name);
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

  /// How many files lie in the folder.
  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

/// The whole of a file.
inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Bytes of a file format, built number by number at stated offsets.
class ByteBlock {
 public:
  ByteBlock(std::size_t size, bool big_endian) : bytes_(size, '\0'), big_endian_(big_endian) {}

  template <class T>
  void put(std::size_t offset, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_[offset + i] = raw[big_endian_ ? sizeof(T) - 1 - i : i];
    }
  }
  void put_text(std::size_t offset, std::string_view text) {
    bytes_.replace(offset, text.size(), text);
  }
  template <class T>
  void append(std::span<const T> values) {
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + values.size() * sizeof(T));
    for (std::size_t i = 0; i < values.size(); ++i) put(begin + i * sizeof(T), values[i]);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  bool big_endian_;
};

/// The bytes of numbers in the given byte order.
template <class T>
std::string bytes_of(const std::vector<T>& values, bool big_endian = false) {
  ByteBlock block(0, big_endian);
  block.append(std::span<const T>(values));
  return block.bytes();
}

/// One gzip (31) or zlib (15) stream of some bytes, by the window bits zlib asks for.
inline std::string deflated(std::string_view bytes, int window_bits = 31) {
  z_stream zlib{};
  deflateInit2(&zlib, 6, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&zlib, bytes.size()) + 64, '\0');
  std::string input(bytes);
  zlib.next_in = reinterpret_cast<Bytef*>(input.data());
  zlib.avail_in = static_cast<uInt>(input.size());
  zlib.next_out = reinterpret_cast<Bytef*>(packed.data());
  zlib.avail_out = static_cast<uInt>(packed.size());
  deflate(&zlib, Z_FINISH);
  packed.resize(zlib.total_out);
  deflateEnd(&zlib);
  return packed;
}

}  // namespace nacre::testing
