#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string_view>

namespace nacre {

/// The type a sample is stored in. Volumes keep the type of their file: an 8-bit scan stays 8-bit.
enum class ScalarType : std::uint8_t { U8, I8, U16, I16, U32, I32, F32, F64 };

/// Bytes of one sample: 1, 2, 4 or 8.
std::size_t size_of(ScalarType type) noexcept;

/// "u8", "i8", "u16", "i16", "u32", "i32", "f32", "f64".
std::string_view name(ScalarType type) noexcept;

/// The bytes of a volume's samples: uninitialised on creation, owned, moved and never copied by
/// accident (a volume can be most of a machine's memory).
class SampleBuffer {
 public:
  SampleBuffer() = default;

  /// @param size  bytes
  /// @throws std::bad_alloc
  explicit SampleBuffer(std::size_t size);

  std::size_t size() const noexcept { return size_; }
  std::byte* data() noexcept { return bytes_.get(); }
  const std::byte* data() const noexcept { return bytes_.get(); }

 private:
  struct Free {
    void operator()(std::byte* bytes) const noexcept { std::free(bytes); }
  };
  std::unique_ptr<std::byte, Free> bytes_;
  std::size_t size_ = 0;
};

/// Scalar samples on a regular grid, trilinear between samples.
///
/// Sample (x, y, z) is element `x + dims.x * (y + dims.y * z)` of `samples` (x fastest), and stands
/// for the value `slope * stored + intercept`. All samples are finite: readers replace NaN and
/// infinities, no other module knows them. An axis of one sample spans one spacing, constant.
struct Volume {
  glm::i64vec3 dims{0};              ///< samples along x, y, z; each at least 1
  ScalarType type = ScalarType::U8;  ///< of the stored samples
  SampleBuffer samples;              ///< dims.x * dims.y * dims.z * size_of(type) bytes
  double slope = 1.0;                ///< not 0, finite
  double intercept = 0.0;            ///< finite
  glm::dmat4 world_from_voxel{1.0};  ///< voxel indices to LPS millimetres; affine, regular
};

/// A volume of the given shape with uninitialised samples and the identity geometry.
///
/// @param dims  each at least 1
/// @throws Error           BadArgument if a dimension is below 1 or the byte count overflows
/// @throws std::bad_alloc  where there is not enough memory
Volume make_volume(const glm::i64vec3& dims, ScalarType type);

/// Number of samples: dims.x * dims.y * dims.z.
std::size_t sample_count(const Volume& volume) noexcept;

/// The C++ type's ScalarType, at compile time.
template <class T>
constexpr ScalarType scalar_type_of();

/// The stored samples as their own type.
/// @pre  scalar_type_of<T>() == volume.type
template <class T>
std::span<T> samples_as(Volume& volume) noexcept;
template <class T>
std::span<const T> samples_as(const Volume& volume) noexcept;

/// Calls `function(std::span<const T>)` with the samples as their own type: one function body for
/// the eight stored types. Returns what it returns.
template <class Function>
decltype(auto) visit_samples(const Volume& volume, Function&& function);

/// The same with samples that may be written.
template <class Function>
decltype(auto) visit_samples(Volume& volume, Function&& function);

/// Calls `function(T{})` with a value of the C++ type that `type` names.
template <class Function>
decltype(auto) visit_scalar_type(ScalarType type, Function&& function);

// Implementation of the templates.

template <class T>
constexpr ScalarType scalar_type_of() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return ScalarType::U8;
  if constexpr (std::is_same_v<T, std::int8_t>) return ScalarType::I8;
  if constexpr (std::is_same_v<T, std::uint16_t>) return ScalarType::U16;
  if constexpr (std::is_same_v<T, std::int16_t>) return ScalarType::I16;
  if constexpr (std::is_same_v<T, std::uint32_t>) return ScalarType::U32;
  if constexpr (std::is_same_v<T, std::int32_t>) return ScalarType::I32;
  if constexpr (std::is_same_v<T, float>) return ScalarType::F32;
  if constexpr (std::is_same_v<T, double>) return ScalarType::F64;
}

template <class T>
std::span<T> samples_as(Volume& volume) noexcept {
  return {reinterpret_cast<T*>(volume.samples.data()), volume.samples.size() / sizeof(T)};
}

template <class T>
std::span<const T> samples_as(const Volume& volume) noexcept {
  return {reinterpret_cast<const T*>(volume.samples.data()), volume.samples.size() / sizeof(T)};
}

template <class Function>
decltype(auto) visit_scalar_type(ScalarType type, Function&& function) {
  switch (type) {
    case ScalarType::U8: return function(std::uint8_t{});
    case ScalarType::I8: return function(std::int8_t{});
    case ScalarType::U16: return function(std::uint16_t{});
    case ScalarType::I16: return function(std::int16_t{});
    case ScalarType::U32: return function(std::uint32_t{});
    case ScalarType::I32: return function(std::int32_t{});
    case ScalarType::F32: return function(float{});
    case ScalarType::F64: break;
  }
  return function(double{});
}

template <class Function>
decltype(auto) visit_samples(const Volume& volume, Function&& function) {
  return visit_scalar_type(volume.type, [&](auto zero) -> decltype(auto) {
    return function(samples_as<decltype(zero)>(volume));
  });
}

template <class Function>
decltype(auto) visit_samples(Volume& volume, Function&& function) {
  return visit_scalar_type(volume.type, [&](auto zero) -> decltype(auto) {
    return function(samples_as<decltype(zero)>(volume));
  });
}

}  // namespace nacre
