#include "io/apng_picture.h"

#include <fmt/core.h>
#include <zlib.h>

#include <limits>
#include <string_view>

#include "core/error.h"
#include "io/png_picture.h"

namespace nacre {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kChunkFrame = 12;  // bytes of a chunk beside its data: length, type, CRC
constexpr int kMostMs = std::numeric_limits<std::uint16_t>::max();

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xffU);
  }
  return bytes;
}

std::string big_endian_16(std::uint16_t value) { return big_endian(value).substr(2); }

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i)
    value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

/// Length, type, data, and the checksum of type and data.
std::string chunk(std::string_view type, std::string_view data) {
  std::string bytes = big_endian(static_cast<std::uint32_t>(data.size()));
  bytes += type;
  bytes += data;
  const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + 4,
                          static_cast<uInt>(bytes.size() - 4));
  return bytes + big_endian(static_cast<std::uint32_t>(crc));
}

/// What a still PNG consists of.
struct PngParts {
  std::string header;  ///< data of IHDR
  std::string pixels;  ///< data of all its IDAT
};

PngParts parts_of(std::string_view png) {
  PngParts parts;
  for (std::size_t at = kSignature.size(); at < png.size();) {
    const std::size_t size = number_at(png, at);
    const std::string_view type = png.substr(at + 4, 4);
    const std::string_view data = png.substr(at + 8, size);
    if (type == "IHDR") parts.header = data;
    if (type == "IDAT") parts.pixels += data;
    at += kChunkFrame + size;
  }
  return parts;
}

}  // namespace

ApngWriter::ApngWriter(const std::filesystem::path& path, std::size_t frames, int delay_ms,
                       int bits)
    : path_(path),
      file_(path),
      frames_(static_cast<std::uint32_t>(frames)),
      delay_ms_(static_cast<std::uint16_t>(delay_ms)),
      bits_(bits) {
  // Each frame takes two sequence numbers, which have 31 bits.
  if (frames < 1 || frames > std::size_t{1} << 30 || delay_ms < 0 || delay_ms > kMostMs) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found {} frames of {} ms, expected 1 or more of 0 to {} ms",
                            path.string(), frames, delay_ms, kMostMs));
  }
}

void ApngWriter::write_frame_control(const DisplayImage& frame) {
  file_.write(chunk("fcTL", big_endian(sequence_++) +
                                big_endian(static_cast<std::uint32_t>(frame.width)) +
                                big_endian(static_cast<std::uint32_t>(frame.height)) +
                                big_endian(0) + big_endian(0) +  // at the corner
                                big_endian_16(delay_ms_) + big_endian_16(1000) +
                                std::string(2, '\0')));  // left as it is, written over
}

void ApngWriter::add(const DisplayImage& frame) {
  const PngParts parts = parts_of(encode_png(frame, bits_));
  if (added_ == frames_ || (added_ > 0 && parts.header != header_)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found a frame {} of {} x {} pixels and {} channels, expected {} "
                            "frames like the first one",
                            path_.string(), added_ + 1, frame.width, frame.height, frame.channels,
                            frames_));
  }
  if (added_ == 0) {
    header_ = parts.header;
    file_.write(kSignature);
    file_.write(chunk("IHDR", header_));
    file_.write(chunk("acTL", big_endian(frames_) + big_endian(0)));  // 0: plays for ever
  }
  write_frame_control(frame);
  file_.write(added_ == 0 ? chunk("IDAT", parts.pixels)
                          : chunk("fdAT", big_endian(sequence_++) + parts.pixels));
  ++added_;
}

void ApngWriter::commit() {
  if (added_ != frames_) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found {} frames, expected {}", path_.string(), added_, frames_));
  }
  file_.write(chunk("IEND", {}));
  file_.commit();
}

}  // namespace nacre
