#include "io/gzip_writer.h"

#include <zlib.h>

#include <algorithm>
#include <new>
#include <vector>

namespace nacre {
namespace {

constexpr std::size_t kChunkSize = std::size_t{256} << 10;

}  // namespace

class GzipWriter::Stream {
 public:
  explicit Stream(AtomicFile& file) : file_(file), packed_(kChunkSize) {
    constexpr int window_bits = 15 + 16;  // + 16: with gzip's header and checksum
    constexpr int memory_level = 8;
    if (deflateInit2(&zlib_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, window_bits, memory_level,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
      throw std::bad_alloc();
    }
  }

  ~Stream() { deflateEnd(&zlib_); }

  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  void pack(std::span<const std::byte> bytes, int flush) {
    // zlib's interface is not const-correct; it does not write to its input.
    zlib_.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
    zlib_.avail_in = static_cast<uInt>(bytes.size());
    int state = Z_OK;
    do {
      zlib_.next_out = packed_.data();
      zlib_.avail_out = static_cast<uInt>(packed_.size());
      state = deflate(&zlib_, flush);
      file_.write(std::as_bytes(std::span(packed_).first(packed_.size() - zlib_.avail_out)));
    } while (zlib_.avail_out == 0 || (flush == Z_FINISH && state != Z_STREAM_END));
  }

 private:
  AtomicFile& file_;
  std::vector<unsigned char> packed_;
  z_stream zlib_{};
};

GzipWriter::GzipWriter(AtomicFile& file) : stream_(std::make_unique<Stream>(file)) {}

GzipWriter::~GzipWriter() = default;

void GzipWriter::write(std::span<const std::byte> bytes) {
  constexpr std::size_t max_input = std::size_t{1} << 30;  // zlib counts in 32 bits
  while (!bytes.empty()) {
    const auto part = bytes.first(std::min(bytes.size(), max_input));
    stream_->pack(part, Z_NO_FLUSH);
    bytes = bytes.subspan(part.size());
  }
}

void GzipWriter::finish() { stream_->pack({}, Z_FINISH); }

}  // namespace nacre
