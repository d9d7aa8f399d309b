#include "render/cpu/thread_pixels.h"

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

template <class Pixel>
void merge_row(std::span<Pixel> into, std::span<const Pixel> from) {
  for (std::size_t x = 0; x < into.size(); ++x) {
    if constexpr (kCounts<Pixel> || kSums<Pixel>) {
      into[x] += from[x];
    } else {
      into[x] = std::max(into[x], from[x]);
    }
  }
}

}  // namespace

template <class Pixel>
class ThreadPixels<Pixel>::Layers {
 public:
  void begin(const glm::ivec2& size) {
    size_ = size;
    for (Layer<Pixel>& layer : layers_) layer.used = false;
  }

  PixelTarget<Pixel> target() {
    Layer<Pixel>& layer = layers_.local();
    if (!layer.used) {
      layer.pixels.assign(
          static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) + kPixelPadding, 0);
      layer.used = true;
    }
    return {layer.pixels.data(), size_.x, size_.y};
  }

  void merge(const std::function<void(int, std::span<const Pixel>)>& show) {
    std::vector<std::span<Pixel>> used;
    for (Layer<Pixel>& layer : layers_) {
      if (layer.used) used.emplace_back(layer.pixels);
    }
    if (used.empty()) return;
    const auto width = static_cast<std::size_t>(size_.x);
    tbb::parallel_for(tbb::blocked_range<int>(0, size_.y, kRowsPerTask), [&](const auto& rows) {
      for (int y = rows.begin(); y != rows.end(); ++y) {
        const std::size_t first = static_cast<std::size_t>(y) * width;
        const std::span<Pixel> row = used[0].subspan(first, width);
        for (std::size_t i = 1; i < used.size(); ++i) {
          merge_row<Pixel>(row, used[i].subspan(first, width));
        }
        show(y, row);
      }
    });
  }

  std::span<Pixel> merged() {
    target();  // blank, if no thread has drawn
    merge([](int, std::span<const Pixel>) {});
    const auto used =
        std::find_if(layers_.begin(), layers_.end(), [](const auto& layer) { return layer.used; });
    return std::span(used->pixels).first(used->pixels.size() - kPixelPadding);
  }

  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const Layer<Pixel>& layer : layers_) sum += layer.pixels.size() * sizeof(Pixel);
    return sum;
  }

 private:
  glm::ivec2 size_{0};
  tbb::enumerable_thread_specific<Layer<Pixel>> layers_;
};

template <class Pixel>
ThreadPixels<Pixel>::ThreadPixels() : layers_(std::make_unique<Layers>()) {}
template <class Pixel>
ThreadPixels<Pixel>::~ThreadPixels() = default;
template <class Pixel>
ThreadPixels<Pixel>::ThreadPixels(ThreadPixels&&) noexcept = default;
template <class Pixel>
ThreadPixels<Pixel>& ThreadPixels<Pixel>::operator=(ThreadPixels&&) noexcept = default;

template <class Pixel>
void ThreadPixels<Pixel>::begin(const glm::ivec2& size) {
  layers_->begin(size);
}

template <class Pixel>
PixelTarget<Pixel> ThreadPixels<Pixel>::target() {
  return layers_->target();
}

template <class Pixel>
void ThreadPixels<Pixel>::merge(const std::function<void(int, std::span<const Pixel>)>& show) {
  layers_->merge(show);
}

template <class Pixel>
std::span<Pixel> ThreadPixels<Pixel>::merged() {
  return layers_->merged();
}

template <class Pixel>
std::size_t ThreadPixels<Pixel>::bytes() const {
  return layers_->bytes();
}

template class ThreadPixels<std::uint8_t>;
template class ThreadPixels<std::uint16_t>;
template class ThreadPixels<float>;
template class ThreadPixels<std::int32_t>;
template class ThreadPixels<std::int64_t>;
template class ThreadPixels<std::uint64_t>;

}  // namespace nacre
