#include "io/png_picture.h"

#include <fmt/core.h>
#include <png.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"

namespace nacre {
namespace {

constexpr png_uint_32 kMostPixels = 32768;

// libpng reports through longjmp unless the handler leaves otherwise; throwing is the way that runs
// destructors (libpng is built with unwind tables on every Linux we build for).
[[noreturn]] void throw_png_error(png_structp png, png_const_charp message) {
  const auto* path = static_cast<const std::filesystem::path*>(png_get_error_ptr(png));
  throw Error(ErrorCode::BadFile, fmt::format("{}: found a damaged PNG ({}), expected a whole one",
                                              path->string(), message));
}

void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

void append_bytes(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

void no_flush(png_structp /*png*/) {}

/// One row in PNG's byte order.
void pack_row(std::span<const std::uint16_t> row, int bits, std::vector<png_byte>& packed) {
  packed.clear();
  for (const std::uint16_t value : row) {
    if (bits == 16) {
      packed.push_back(static_cast<png_byte>(value >> 8));
      packed.push_back(static_cast<png_byte>(value & 0xff));
    } else {
      packed.push_back(static_cast<png_byte>((value + 128u) / 257u));  // 65535 / 255 = 257
    }
  }
}

struct Writer {
  png_structp png;
  png_infop info;

  /// @param path  for messages
  explicit Writer(const std::filesystem::path& path)
      : png(png_create_write_struct(PNG_LIBPNG_VER_STRING,
                                    const_cast<std::filesystem::path*>(&path), throw_png_error,
                                    ignore_warning)),
        info(png_create_info_struct(png)) {}
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
};

struct Reader {
  png_structp png;
  png_infop info;

  explicit Reader(const std::filesystem::path& path)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, const_cast<std::filesystem::path*>(&path),
                                   throw_png_error, ignore_warning)),
        info(png_create_info_struct(png)) {}
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

/// Asks libpng for 16-bit gray or RGB, whatever the file holds.
void normalise(const Reader& reader) {
  png_set_expand_16(reader.png);
  png_set_palette_to_rgb(reader.png);
  png_set_expand_gray_1_2_4_to_8(reader.png);
  png_set_strip_alpha(reader.png);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
}

}  // namespace

std::string encode_png(const DisplayImage& picture, int bits) {
  if (bits != 8 && bits != 16) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("PNG: found {} bits a channel, expected 8 or 16", bits));
  }
  std::string bytes;
  const std::filesystem::path nowhere("PNG");
  const Writer writer(nowhere);
  png_set_write_fn(writer.png, &bytes, append_bytes, no_flush);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(picture.width),
               static_cast<png_uint_32>(picture.height), bits,
               picture.channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writer.png, writer.info);
  const std::size_t row_size =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.channels);
  std::vector<png_byte> packed;
  for (int y = 0; y < picture.height; ++y) {
    pack_row(std::span(picture.pixels).subspan(static_cast<std::size_t>(y) * row_size, row_size),
             bits, packed);
    png_write_row(writer.png, packed.data());
  }
  png_write_end(writer.png, nullptr);
  return bytes;
}

void write_png(const DisplayImage& picture, const std::filesystem::path& path, int bits) {
  AtomicFile file(path);  // first, so that a name that cannot be is found before the work
  file.write(encode_png(picture, bits));
  file.commit();
}

DisplayImage read_png(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (file == nullptr) {
    throw Error(ErrorCode::BadFile,
                fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
  }
  const Reader reader(path);
  png_init_io(reader.png, file.get());
  png_set_user_limits(reader.png, kMostPixels, kMostPixels);
  png_read_info(reader.png, reader.info);
  normalise(reader);

  DisplayImage picture;
  picture.width = static_cast<int>(png_get_image_width(reader.png, reader.info));
  picture.height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  picture.channels = png_get_channels(reader.png, reader.info);
  const std::size_t row_bytes = png_get_rowbytes(reader.png, reader.info);
  std::vector<png_byte> bytes(row_bytes * static_cast<std::size_t>(picture.height));
  std::vector<png_bytep> rows;
  rows.reserve(static_cast<std::size_t>(picture.height));
  for (int y = 0; y < picture.height; ++y) {
    rows.push_back(bytes.data() + static_cast<std::size_t>(y) * row_bytes);
  }
  png_read_image(reader.png, rows.data());
  picture.pixels.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    picture.pixels.push_back(static_cast<std::uint16_t>(bytes[i] << 8 | bytes[i + 1]));
  }
  return picture;
}

}  // namespace nacre
