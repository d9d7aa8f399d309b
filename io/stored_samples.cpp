#include "io/stored_samples.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "io/bad_file.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

std::optional<ScalarType> scalar_type(StoredType type) {
  if (type == StoredType::I64 || type == StoredType::U64) return std::nullopt;
  return static_cast<ScalarType>(type);
}

/// Bytes of all samples in the files; refuses what no file can mean.
std::uint64_t checked_size(const fs::path& path, const StoredSamples& stored) {
  std::uint64_t size = size_of(stored.type);
  // Room for offsets and for the sums that callers make.
  constexpr std::uint64_t limit = std::uint64_t{1} << 60;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t count = stored.dims[axis];
    if (count < 1 || static_cast<std::uint64_t>(count) > limit / size) {
      throw_bad_file(
          path, fmt::format("{} x {} x {} samples", stored.dims.x, stored.dims.y, stored.dims.z),
          "at least one along each axis, and less than 2^60 bytes");
    }
    size *= static_cast<std::uint64_t>(count);
  }
  if (size / size_of(stored.type) % stored.pieces.size() != 0) {
    throw_bad_file(path, fmt::format("{} data files", stored.pieces.size()),
                   "a number that divides the samples evenly");
  }
  return size;
}

/// The files of a volume as one stream that must not end early.
class PieceReader {
 public:
  PieceReader(const StoredSamples& stored, std::uint64_t size)
      : pieces_(stored.pieces), piece_size_(size / stored.pieces.size()) {
    for (Stretch& piece : pieces_) {
      if (stored.at_file_end) {
        if (piece.packing != Packing::Raw) {
          throw_bad_file(piece.path, "compressed samples to be counted from the end", "raw ones");
        }
        const std::uint64_t file_size = file_size_of(piece.path);
        piece.offset = file_size - std::min(file_size, piece_size_);
      }
      check_stretch_holds(piece, piece_size_);
    }
  }

  /// Fills `bytes` across the borders of pieces.
  void read(std::span<std::byte> bytes, VolumeReadReport& report) {
    while (!bytes.empty()) {
      if (!reader_) reader_.emplace(pieces_[piece_]);
      const auto part = bytes.first(std::min<std::uint64_t>(bytes.size(), piece_size_ - done_));
      const std::size_t count = reader_->read_some(part);
      done_ += count;
      if (count != part.size()) {
        throw_bad_file(pieces_[piece_].path, fmt::format("{} bytes of samples", done_),
                       fmt::format("{}", piece_size_));
      }
      if (done_ == piece_size_) finish_piece(report);
      bytes = bytes.subspan(count);
    }
  }

 private:
  void finish_piece(VolumeReadReport& report) {
    if (!reader_->at_end()) {
      report.warnings.push_back(fmt::format("{}: more bytes than the header's samples, ignored",
                                            pieces_[piece_].path.filename().string()));
    }
    reader_.reset();
    done_ = 0;
    ++piece_;
  }

  std::vector<Stretch> pieces_;
  std::uint64_t piece_size_;
  std::optional<StretchReader> reader_;
  std::size_t piece_ = 0;
  std::uint64_t done_ = 0;
};

/// Reads 64-bit integers chunk by chunk, keeps their low 32 bits, and finds the type these have.
template <class Wide>
Volume read_wide(const fs::path& path, const StoredSamples& stored, PieceReader& reader,
                 VolumeReadReport& report) {
  Volume volume = make_volume(stored.dims, ScalarType::U32);
  std::vector<Wide> chunk(std::size_t{1} << 15);
  Wide lowest = std::numeric_limits<Wide>::max();
  Wide highest = std::numeric_limits<Wide>::lowest();
  const std::span<std::uint32_t> samples = samples_as<std::uint32_t>(volume);
  for (std::size_t begin = 0; begin < samples.size(); begin += chunk.size()) {
    const std::size_t count = std::min(chunk.size(), samples.size() - begin);
    const auto bytes = std::as_writable_bytes(std::span(chunk).first(count));
    reader.read(bytes, report);
    if (stored.big_endian != (std::endian::native == std::endian::big)) {
      swap_bytes(bytes, sizeof(Wide));
    }
    for (std::size_t i = 0; i < count; ++i) {
      lowest = std::min(lowest, chunk[i]);
      highest = std::max(highest, chunk[i]);
      samples[begin + i] = static_cast<std::uint32_t>(chunk[i]);
    }
  }
  if (std::in_range<std::int32_t>(lowest) && std::in_range<std::int32_t>(highest)) {
    volume.type = ScalarType::I32;
  } else if (!std::in_range<std::uint32_t>(lowest) || !std::in_range<std::uint32_t>(highest)) {
    throw_bad_file(path, fmt::format("64-bit integers from {} to {}", lowest, highest),
                   "integers that fit 32 bits");
  }
  report.warnings.push_back(
      fmt::format("64-bit integers, kept in 32 bits ({}): all fit", name(volume.type)));
  return volume;
}

template <class Word, class Swap>
void swap_words(std::span<std::byte> bytes, Swap swap) {
  for (std::size_t begin = 0; begin + sizeof(Word) <= bytes.size(); begin += sizeof(Word)) {
    Word word{};
    std::memcpy(&word, bytes.data() + begin, sizeof(Word));
    word = swap(word);
    std::memcpy(bytes.data() + begin, &word, sizeof(Word));
  }
}

}  // namespace

std::size_t size_of(StoredType type) noexcept {
  const std::optional<ScalarType> scalar = scalar_type(type);
  return scalar ? size_of(*scalar) : 8;
}

StoredType integer_type(std::size_t size, bool is_signed) noexcept {
  switch (size) {
    case 1: return is_signed ? StoredType::I8 : StoredType::U8;
    case 2: return is_signed ? StoredType::I16 : StoredType::U16;
    case 4: return is_signed ? StoredType::I32 : StoredType::U32;
    default: return is_signed ? StoredType::I64 : StoredType::U64;
  }
}

Volume read_stored_samples(const fs::path& path, const StoredSamples& stored,
                           VolumeReadReport& report) {
  const std::uint64_t size = checked_size(path, stored);
  PieceReader reader(stored, size);
  if (stored.type == StoredType::I64) return read_wide<std::int64_t>(path, stored, reader, report);
  if (stored.type == StoredType::U64) return read_wide<std::uint64_t>(path, stored, reader, report);

  Volume volume = make_volume(stored.dims, *scalar_type(stored.type));
  const std::span<std::byte> samples(volume.samples.data(), volume.samples.size());
  reader.read(samples, report);
  if (stored.big_endian != (std::endian::native == std::endian::big)) {
    swap_bytes(samples, size_of(stored.type));
  }
  return volume;
}

void swap_bytes(std::span<std::byte> bytes, std::size_t size) {
  switch (size) {
    case 2:
      swap_words<std::uint16_t>(bytes, [](auto word) { return __builtin_bswap16(word); });
      break;
    case 4:
      swap_words<std::uint32_t>(bytes, [](auto word) { return __builtin_bswap32(word); });
      break;
    case 8:
      swap_words<std::uint64_t>(bytes, [](auto word) { return __builtin_bswap64(word); });
      break;
    default: break;
  }
}

}  // namespace nacre
