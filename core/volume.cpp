#include "core/volume.h"

#include <fmt/core.h>

#include <new>

#include "core/error.h"

namespace nacre {

std::size_t size_of(ScalarType type) noexcept {
  return visit_scalar_type(type, [](auto zero) { return sizeof(zero); });
}

std::string_view name(ScalarType type) noexcept {
  switch (type) {
    case ScalarType::U8: return "u8";
    case ScalarType::I8: return "i8";
    case ScalarType::U16: return "u16";
    case ScalarType::I16: return "i16";
    case ScalarType::U32: return "u32";
    case ScalarType::I32: return "i32";
    case ScalarType::F32: return "f32";
    case ScalarType::F64: return "f64";
  }
  return "unknown";
}

SampleBuffer::SampleBuffer(std::size_t size)
    : bytes_(static_cast<std::byte*>(std::malloc(size > 0 ? size : 1))), size_(size) {
  if (bytes_ == nullptr) throw std::bad_alloc();
}

Volume make_volume(const glm::i64vec3& dims, ScalarType type) {
  std::size_t size = size_of(type);
  for (int axis = 0; axis < 3; ++axis) {
    if (dims[axis] < 1) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("volume of {} x {} x {} samples, expected at least 1 along each axis",
                              dims.x, dims.y, dims.z));
    }
    if (__builtin_mul_overflow(size, static_cast<std::size_t>(dims[axis]), &size)) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("volume of {} x {} x {} samples, expected less than 2^64 bytes",
                              dims.x, dims.y, dims.z));
    }
  }
  Volume volume;
  volume.dims = dims;
  volume.type = type;
  volume.samples = SampleBuffer(size);
  return volume;
}

std::size_t sample_count(const Volume& volume) noexcept {
  return volume.samples.size() / size_of(volume.type);
}

}  // namespace nacre
