#include "render/cpu/max_picture.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace nacre {
namespace {

/// Pixels of one thread; all 0 unless used since `begin`.
template <class Pixel>
struct Layer {
  std::vector<Pixel> pixels;
  bool used = false;
};

constexpr int kRowsPerTask = 16;

}  // namespace

template <class Pixel>
class MaxPicture<Pixel>::Layers {
 public:
  void begin(const glm::ivec2& size) {
    size_ = size;
    for (Layer<Pixel>& layer : layers_) layer.used = false;
  }

  PixelTarget<Pixel> target() {
    Layer<Pixel>& layer = layers_.local();
    if (!layer.used) {
      layer.pixels.assign(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y), 0);
      layer.used = true;
    }
    return {layer.pixels.data(), size_.x, size_.y};
  }

  void resolve(std::span<const float> emission_of_rank, const PixelRect& rect, Image& image) {
    std::vector<Pixel*> used;
    for (Layer<Pixel>& layer : layers_) {
      if (layer.used) used.push_back(layer.pixels.data());
    }
    if (used.empty()) return;
    tbb::parallel_for(tbb::blocked_range<int>(0, size_.y, kRowsPerTask), [&](const auto& rows) {
      for (int y = rows.begin(); y != rows.end(); ++y) {
        const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x);
        for (std::size_t i = 1; i < used.size(); ++i) merge(used[0] + first, used[i] + first);
        float* out = &image.at(rect.x, rect.y + y);
        show(used[0] + first, emission_of_rank, out);
      }
    });
  }

  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const Layer<Pixel>& layer : layers_) sum += layer.pixels.size() * sizeof(Pixel);
    return sum;
  }

 private:
  void show(const Pixel* from, std::span<const float> emission_of_rank, float* out) const {
    if constexpr (std::is_same_v<Pixel, float>) {
      std::copy(from, from + size_.x, out);
    } else {
      for (int x = 0; x < size_.x; ++x) out[x] = emission_of_rank[from[x]];
    }
  }

  void merge(Pixel* into, const Pixel* from) const {
    for (int x = 0; x < size_.x; ++x) into[x] = std::max(into[x], from[x]);
  }

  glm::ivec2 size_{0};
  tbb::enumerable_thread_specific<Layer<Pixel>> layers_;
};

template <class Pixel>
MaxPicture<Pixel>::MaxPicture() : layers_(std::make_unique<Layers>()) {}
template <class Pixel>
MaxPicture<Pixel>::~MaxPicture() = default;
template <class Pixel>
MaxPicture<Pixel>::MaxPicture(MaxPicture&&) noexcept = default;
template <class Pixel>
MaxPicture<Pixel>& MaxPicture<Pixel>::operator=(MaxPicture&&) noexcept = default;

template <class Pixel>
void MaxPicture<Pixel>::begin(const glm::ivec2& size) {
  layers_->begin(size);
}

template <class Pixel>
PixelTarget<Pixel> MaxPicture<Pixel>::target() {
  return layers_->target();
}

template <class Pixel>
void MaxPicture<Pixel>::resolve(std::span<const float> emission_of_rank, const PixelRect& rect,
                                Image& image) {
  layers_->resolve(emission_of_rank, rect, image);
}

template <class Pixel>
std::size_t MaxPicture<Pixel>::bytes() const {
  return layers_->bytes();
}

template class MaxPicture<float>;
template class MaxPicture<std::uint8_t>;
template class MaxPicture<std::uint16_t>;

}  // namespace nacre
