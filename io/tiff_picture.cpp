#include "io/tiff_picture.h"

#include <fmt/core.h>
#include <tiffio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"

namespace nacre {
namespace {

constexpr std::uint32_t kMostPixels = 32768;

using Tiff = std::unique_ptr<TIFF, void (*)(TIFF*)>;

/// libtiff prints by itself; this holds its tongue while it is alive.
class SilentTiff {
 public:
  SilentTiff() : error_(TIFFSetErrorHandler(nullptr)), warning_(TIFFSetWarningHandler(nullptr)) {}
  ~SilentTiff() {
    TIFFSetErrorHandler(error_);
    TIFFSetWarningHandler(warning_);
  }
  SilentTiff(const SilentTiff&) = delete;
  SilentTiff& operator=(const SilentTiff&) = delete;

 private:
  TIFFErrorHandler error_;
  TIFFErrorHandler warning_;
};

/// The file in memory: libtiff seeks back to patch headers, an AtomicFile only appends.
struct MemoryFile {
  std::vector<std::byte> bytes;
  std::size_t position = 0;
};

tmsize_t memory_read(thandle_t handle, void* data, tmsize_t size) {
  auto* file = static_cast<MemoryFile*>(handle);
  const std::size_t left = file->bytes.size() - std::min(file->position, file->bytes.size());
  const std::size_t count = std::min(left, static_cast<std::size_t>(size));
  std::copy_n(file->bytes.data() + file->position, count, static_cast<std::byte*>(data));
  file->position += count;
  return static_cast<tmsize_t>(count);
}

tmsize_t memory_write(thandle_t handle, void* data, tmsize_t size) {
  auto* file = static_cast<MemoryFile*>(handle);
  const std::size_t end = file->position + static_cast<std::size_t>(size);
  if (end > file->bytes.size()) file->bytes.resize(end);
  std::copy_n(static_cast<const std::byte*>(data), size, file->bytes.data() + file->position);
  file->position = end;
  return size;
}

toff_t memory_seek(thandle_t handle, toff_t offset, int whence) {
  auto* file = static_cast<MemoryFile*>(handle);
  if (whence == SEEK_SET) file->position = offset;
  if (whence == SEEK_CUR) file->position += offset;
  if (whence == SEEK_END) file->position = file->bytes.size() + offset;
  return file->position;
}

int memory_close(thandle_t /*handle*/) { return 0; }

toff_t memory_size(thandle_t handle) { return static_cast<MemoryFile*>(handle)->bytes.size(); }

void set_tags(TIFF* tiff, const Image& image, const std::string& description) {
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(image.width));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(image.height));
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, static_cast<std::uint32_t>(image.height));
  TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, description.c_str());
}

[[noreturn]] void throw_bad(const std::filesystem::path& path, const std::string& found) {
  throw Error(ErrorCode::BadFile, fmt::format("{}: found {}, expected one channel of float pixels",
                                              path.string(), found));
}

struct Layout {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t bits = 0;
};

/// What the file says it holds, checked against what the file can hold.
Layout checked_layout(TIFF* tiff, const std::filesystem::path& path) {
  Layout layout;
  std::uint16_t channels = 1;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &layout.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &layout.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &layout.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  if (layout.width < 1 || layout.height < 1 || layout.width > kMostPixels ||
      layout.height > kMostPixels) {
    throw_bad(path, fmt::format("a picture of {} x {} pixels", layout.width, layout.height));
  }
  if (channels != 1) throw_bad(path, fmt::format("{} channels", channels));
  if (format != SAMPLEFORMAT_IEEEFP || (layout.bits != 32 && layout.bits != 64)) {
    throw_bad(path, fmt::format("{}-bit {}", layout.bits,
                                format == SAMPLEFORMAT_IEEEFP ? "floats" : "integers"));
  }
  if (TIFFIsTiled(tiff) != 0) throw_bad(path, "tiles");
  return layout;
}

std::vector<std::byte> read_bytes(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  std::error_code failure;
  const auto size = std::filesystem::file_size(path, failure);
  if (file == nullptr || failure) {
    throw Error(ErrorCode::BadFile,
                fmt::format("{}: cannot be opened: {}", path.string(),
                            failure ? failure.message() : std::strerror(errno)));
  }
  std::vector<std::byte> bytes(size);
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
  return bytes;
}

Tiff open_in_memory(MemoryFile& file, const char* mode) {
  return {TIFFClientOpen("memory", mode, &file, memory_read, memory_write, memory_seek,
                         memory_close, memory_size, nullptr, nullptr),
          TIFFClose};
}

}  // namespace

std::vector<std::byte> encode_tiff(const Image& image, const std::string& description) {
  const SilentTiff silent;
  MemoryFile memory;
  {
    const Tiff tiff = open_in_memory(memory, "wm");
    if (tiff == nullptr) throw std::bad_alloc();
    set_tags(tiff.get(), image, description);
    TIFFWriteEncodedStrip(tiff.get(), 0, const_cast<float*>(image.pixels.data()),
                          static_cast<tmsize_t>(image.pixels.size() * sizeof(float)));
  }
  return std::move(memory.bytes);
}

void write_tiff(const Image& image, const std::filesystem::path& path,
                const std::string& description) {
  AtomicFile out(path);  // first, so that a name that cannot be is found before the work
  out.write(encode_tiff(image, description));
  out.commit();
}

TiffPicture read_tiff(const std::filesystem::path& path) {
  const SilentTiff silent;
  MemoryFile memory{read_bytes(path)};
  const Tiff tiff = open_in_memory(memory, "rm");
  if (tiff == nullptr) throw_bad(path, "no TIFF");
  const Layout layout = checked_layout(tiff.get(), path);

  TiffPicture picture{make_image(static_cast<int>(layout.width), static_cast<int>(layout.height)),
                      {}};
  const char* description = nullptr;
  if (TIFFGetField(tiff.get(), TIFFTAG_IMAGEDESCRIPTION, &description) == 1) {
    picture.description = description;
  }
  std::vector<std::byte> row(static_cast<std::size_t>(TIFFScanlineSize(tiff.get())));
  for (std::uint32_t y = 0; y < layout.height; ++y) {
    if (TIFFReadScanline(tiff.get(), row.data(), y, 0) < 0) {
      throw_bad(path, fmt::format("{} of {} rows", y, layout.height));
    }
    float* out = &picture.image.at(0, static_cast<int>(y));
    for (std::uint32_t x = 0; x < layout.width; ++x) {
      if (layout.bits == 32) {
        std::memcpy(out + x, row.data() + sizeof(float) * x, sizeof(float));
      } else {
        double value = 0.0;
        std::memcpy(&value, row.data() + sizeof(double) * x, sizeof(double));
        out[x] = static_cast<float>(value);
      }
    }
  }
  return picture;
}

}  // namespace nacre
