#include "render/cpu/rank_picture.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace nacre {
namespace {

/// Pixels of one thread; all 0 unless used since `begin`.
template <class Rank>
struct Layer {
  std::vector<Rank> pixels;
  bool used = false;
};

constexpr int kRowsPerTask = 16;

}  // namespace

template <class Rank>
class RankPicture<Rank>::Layers {
 public:
  void begin(const glm::ivec2& size) {
    size_ = size;
    for (Layer<Rank>& layer : layers_) layer.used = false;
  }

  RankTarget<Rank> target() {
    Layer<Rank>& layer = layers_.local();
    if (!layer.used) {
      layer.pixels.assign(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y), 0);
      layer.used = true;
    }
    return {layer.pixels.data(), size_.x, size_.y};
  }

  void resolve(std::span<const float> emission_of_rank, const PixelRect& rect, Image& image) {
    std::vector<Rank*> used;
    for (Layer<Rank>& layer : layers_) {
      if (layer.used) used.push_back(layer.pixels.data());
    }
    if (used.empty()) return;
    tbb::parallel_for(tbb::blocked_range<int>(0, size_.y, kRowsPerTask), [&](const auto& rows) {
      for (int y = rows.begin(); y != rows.end(); ++y) {
        const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x);
        for (std::size_t i = 1; i < used.size(); ++i) merge(used[0] + first, used[i] + first);
        float* out = &image.at(rect.x, rect.y + y);
        for (int x = 0; x < size_.x; ++x) out[x] = emission_of_rank[used[0][first + x]];
      }
    });
  }

 private:
  void merge(Rank* into, const Rank* from) const {
    for (int x = 0; x < size_.x; ++x) into[x] = std::max(into[x], from[x]);
  }

  glm::ivec2 size_{0};
  tbb::enumerable_thread_specific<Layer<Rank>> layers_;
};

template <class Rank>
RankPicture<Rank>::RankPicture() : layers_(std::make_unique<Layers>()) {}
template <class Rank>
RankPicture<Rank>::~RankPicture() = default;
template <class Rank>
RankPicture<Rank>::RankPicture(RankPicture&&) noexcept = default;
template <class Rank>
RankPicture<Rank>& RankPicture<Rank>::operator=(RankPicture&&) noexcept = default;

template <class Rank>
void RankPicture<Rank>::begin(const glm::ivec2& size) {
  layers_->begin(size);
}

template <class Rank>
RankTarget<Rank> RankPicture<Rank>::target() {
  return layers_->target();
}

template <class Rank>
void RankPicture<Rank>::resolve(std::span<const float> emission_of_rank, const PixelRect& rect,
                                Image& image) {
  layers_->resolve(emission_of_rank, rect, image);
}

template class RankPicture<std::uint8_t>;
template class RankPicture<std::uint16_t>;

}  // namespace nacre
