#include "io/stretch.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <system_error>
#include <vector>

#include "io/bad_file.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChunkSize = std::size_t{256} << 10;
// A deflate block cannot hold more than 1032 bytes a byte; the rest is slack for headers.
constexpr std::uint64_t kMaxGrowth = 1100;
constexpr std::uint64_t kSlack = 4096;

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

File open_file(const fs::path& path) {
  File file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) throw_bad_file(path, "a file that cannot be opened", "a readable file");
  return file;
}

}  // namespace

std::uint64_t file_size_of(const fs::path& path) {
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status)) throw_bad_file(path, "no such file", "a volume file");
  if (!fs::is_regular_file(status)) throw_bad_file(path, "not a regular file", "a volume file");
  const std::uintmax_t size = fs::file_size(path, failure);
  if (failure) throw_bad_file(path, "a file without a size", "a volume file");
  return size;
}

Packing packing_of(const fs::path& path) {
  std::array<unsigned char, 2> magic{};
  const File file = open_file(path);
  const std::size_t count = std::fread(magic.data(), 1, magic.size(), file.get());
  const bool gzip = count == magic.size() && magic[0] == 0x1f && magic[1] == 0x8b;
  return gzip ? Packing::Deflated : Packing::Raw;
}

void check_stretch_holds(const Stretch& stretch, std::uint64_t size) {
  const std::uint64_t file_size = file_size_of(stretch.path);
  const std::uint64_t packed = file_size - std::min(stretch.offset, file_size);
  std::uint64_t held = packed;
  if (stretch.packing == Packing::Deflated) {
    constexpr std::uint64_t limit = std::numeric_limits<std::uint64_t>::max();
    held = packed > (limit - kSlack) / kMaxGrowth ? limit : packed * kMaxGrowth + kSlack;
  }
  if (stretch.skip <= held && size <= held - stretch.skip) return;
  const char* kind = stretch.packing == Packing::Raw ? "bytes" : "compressed bytes";
  throw_bad_file(stretch.path, fmt::format("{} {} for samples", packed, kind),
                 fmt::format("{} bytes of samples, as the header says", size));
}

/// The open file and, for a packed stretch, the state of unpacking it.
class StretchReader::Source {
 public:
  explicit Source(const Stretch& stretch) : stretch_(stretch), file_(open_file(stretch.path)) {
    if (fseeko(file_.get(), static_cast<off_t>(stretch.offset), SEEK_SET) != 0) {
      throw_bad_file(stretch.path, fmt::format("no byte {}", stretch.offset), "a longer file");
    }
    if (stretch.packing == Packing::Raw) return;
    input_.resize(kChunkSize);
    // 15 bits of window, and + 32: gzip or zlib, whichever the first bytes say.
    if (inflateInit2(&zlib_, 15 + 32) != Z_OK) throw std::bad_alloc();
  }

  ~Source() {
    if (stretch_.packing == Packing::Deflated) inflateEnd(&zlib_);
  }

  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  std::size_t read_some(std::span<std::byte> bytes) {
    if (stretch_.packing == Packing::Raw) {
      return std::fread(bytes.data(), 1, bytes.size(), file_.get());
    }
    std::size_t done = 0;
    while (done < bytes.size() && !finished_) done += inflate_some(bytes.subspan(done));
    return done;
  }

  bool at_end() {
    std::byte next{};
    if (read_some({&next, 1}) == 1) return false;
    if (cut_off_) {
      throw_bad_file(stretch_.path, "compressed data without its end", "a whole stream");
    }
    return true;
  }

 private:
  /// One step of zlib into `bytes`; sets `finished_` at the end of the stream or of the file.
  std::size_t inflate_some(std::span<std::byte> bytes) {
    if (zlib_.avail_in == 0 && !refill()) {
      finished_ = cut_off_ = true;
      return 0;
    }
    const std::size_t room = std::min<std::size_t>(bytes.size(), std::size_t{1} << 30);
    zlib_.next_out = reinterpret_cast<Bytef*>(bytes.data());
    zlib_.avail_out = static_cast<uInt>(room);
    const int state = inflate(&zlib_, Z_NO_FLUSH);
    const std::size_t made = room - zlib_.avail_out;
    unpacked_ += made;
    if (state == Z_STREAM_END) {
      next_member();
    } else if (state != Z_OK && state != Z_BUF_ERROR) {
      throw_bad_file(stretch_.path,
                     fmt::format("damaged compressed data after {} bytes", unpacked_),
                     "a whole gzip or zlib stream");
    }
    return made;
  }

  bool refill() {
    const std::size_t count = std::fread(input_.data(), 1, input_.size(), file_.get());
    zlib_.next_in = input_.data();
    zlib_.avail_in = static_cast<uInt>(count);
    return count > 0;
  }

  /// gzip files may be several streams one after the other (pigz, bgzip); what follows the last
  /// one and is no gzip stream is not data.
  void next_member() {
    const bool has_more = zlib_.avail_in > 0 || refill();
    finished_ = !has_more || zlib_.next_in[0] != 0x1f || inflateReset(&zlib_) != Z_OK;
  }

  Stretch stretch_;
  File file_;
  std::vector<unsigned char> input_;
  z_stream zlib_{};
  std::uint64_t unpacked_ = 0;
  bool finished_ = false;
  bool cut_off_ = false;  ///< the file ended before the packed stream did
};

StretchReader::StretchReader(const Stretch& stretch) : source_(std::make_unique<Source>(stretch)) {
  std::vector<std::byte> passed(std::min<std::uint64_t>(stretch.skip, kChunkSize));
  for (std::uint64_t left = stretch.skip; left > 0;) {
    const auto chunk = std::span(passed).first(std::min<std::uint64_t>(left, passed.size()));
    if (source_->read_some(chunk) != chunk.size()) {
      throw_bad_file(stretch.path,
                     fmt::format("fewer than {} bytes before the samples", stretch.skip),
                     "a longer file");
    }
    left -= chunk.size();
  }
}

StretchReader::~StretchReader() = default;

std::size_t StretchReader::read_some(std::span<std::byte> bytes) {
  return source_->read_some(bytes);
}

bool StretchReader::at_end() { return source_->at_end(); }

}  // namespace nacre
