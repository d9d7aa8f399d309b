// Maxima between the levels: the filter solves its equations, pixels stay in their layers, errors
// shrink, and nothing depends on the order of rows.
#include "core/dequantization.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace nacre {
namespace {

std::vector<LayerLevel> uniform(int levels) {
  std::vector<LayerLevel> list;
  for (int k = 1; k <= levels; ++k) list.push_back({(k - 0.5) / levels, double(k) / levels});
  return list;
}

/// What ideal shells show of a picture.
Image quantized(const Image& truth, std::span<const LayerLevel> levels) {
  Image shown = truth;
  for (float& pixel : shown.pixels) {
    double representative = 0.0;
    for (const LayerLevel& level : levels) {
      if (double{pixel} >= level.emission) representative = level.representative;
    }
    pixel = static_cast<float>(representative);
  }
  return shown;
}

/// Smooth, from 0 to `brightest`, about two periods of `wave` pixels in each direction.
Image waves(int width, int height, double wave, double brightest = 1.0) {
  Image image = make_image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double value = 0.5 + 0.3 * std::sin(6.2831853 * (x + 0.3 * y) / wave) +
                           0.2 * std::cos(6.2831853 * (y - 0.2 * x) / (1.3 * wave));
      image.at(x, y) = static_cast<float>(brightest * std::clamp(value, 0.0, 1.0));
    }
  }
  return image;
}

Image noise(int width, int height) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(0.0F, 1.0F);
  Image image = make_image(width, height);
  for (float& pixel : image.pixels) pixel = any(random);
  return image;
}

double rmse(const Image& a, const Image& b) {
  double squares = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    squares += std::pow(double{a.pixels[i]} - double{b.pixels[i]}, 2);
  }
  return std::sqrt(squares / static_cast<double>(a.pixels.size()));
}

double gain_db(const Image& truth, std::span<const LayerLevel> levels) {
  const Image flat = quantized(truth, levels);
  Image smooth = flat;
  dequantize(smooth, layer_ranges(levels));
  return 20.0 * std::log10(rmse(truth, flat) / rmse(truth, smooth));
}

/// The differences of a pixel's neighbours to it, by class, one at a time.
std::array<double, 5> differences(const Image& image, int stride, int x, int y) {
  std::array<double, 5> sums{};
  const auto pixel = [&](int i, int j) {
    return double{image.at(std::clamp(i, 0, image.width - 1), std::clamp(j, 0, image.height - 1))};
  };
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const int square = dx * dx + dy * dy;
      if (square == 0) continue;
      const std::size_t index = square == 1   ? 0
                                : square == 2 ? 1
                                : square == 4 ? 2
                                : square == 5 ? 3
                                              : 4;
      sums[index] += pixel(x + stride * dx, y + stride * dy) - pixel(x, y);
    }
  }
  return sums;
}

TEST(Dequantization, LayersLieBetweenLevels) {
  const std::vector<LayerRange> layers = layer_ranges(uniform(4));
  ASSERT_EQ(layers.size(), 5U);
  EXPECT_EQ(layers[0].hi, 0.125F);
  EXPECT_EQ(layers[2].lo, 0.375F);
  EXPECT_EQ(layers[2].shown, 0.5F);
  EXPECT_EQ(layers[2].hi, 0.625F);
  EXPECT_EQ(layers[4].hi, 1.0F);
  EXPECT_EQ(layer_ranges(uniform(4), 0.5)[4].hi, 0.5F);
}

TEST(Dequantization, LayersShownAlikeAreOne) {
  const std::vector<LayerLevel> levels{{0.2, 0.3}, {0.4, 0.3}, {0.6, 0.8}};
  const std::vector<LayerRange> layers = layer_ranges(levels);
  ASSERT_EQ(layers.size(), 3U);
  EXPECT_EQ(layers[1].lo, 0.2F);
  EXPECT_EQ(layers[1].hi, 0.6F);
}

TEST(Dequantization, RepresentativesOutsideTheirLayersMakeNoLayers) {
  const std::vector<LayerLevel> levels{{0.2, 0.3}, {0.4, 0.1}};
  EXPECT_TRUE(layer_ranges(levels).empty());
}

TEST(Dequantization, WeightsSolveTheNormalEquations) {
  const std::vector<LayerLevel> levels = uniform(12);
  const Image shown = quantized(waves(97, 61, 37.0), levels);
  const LayerFilter filter = layer_filter(shown, layer_ranges(levels));
  ASSERT_EQ(filter.stride, 1);
  std::array<std::array<double, 5>, 5> products{};
  double squares = 0.0;  // of neighbours one step to the right and below
  int pixels = 0;
  for (int y = 0; y < shown.height; ++y) {
    for (int x = 0; x < shown.width; ++x) {
      if (shown.at(x, y) == 0.0F) continue;
      ++pixels;
      const std::array<double, 5> own = differences(shown, 1, x, y);
      for (std::size_t i = 0; i < 5; ++i) {
        for (std::size_t j = 0; j < 5; ++j) products[i][j] += own[i] * own[j];
      }
      const int right = std::min(x + 1, shown.width - 1);
      const int below = std::min(y + 1, shown.height - 1);
      squares += std::pow(double{shown.at(right, y)} - double{shown.at(x, y)}, 2);
      squares += std::pow(double{shown.at(x, below)} - double{shown.at(x, y)}, 2);
    }
  }
  // A twelfth wide, the topmost half as wide.
  double widths = 0.0;
  for (const float pixel : shown.pixels) {
    if (pixel > 0.0F) widths += std::pow(pixel == 1.0F ? 1.0 / 24.0 : 1.0 / 12.0, 2);
  }
  const double mean_square = 0.5 * squares / widths;
  ASSERT_GT(mean_square, 0.25);
  const std::array<double, 5> counts{4, 4, 4, 8, 4};
  for (std::size_t i = 0; i < 5; ++i) {
    double left = 0.0;
    for (std::size_t j = 0; j < 5; ++j) left += products[i][j] * filter.weights[j];
    EXPECT_NEAR(left / (counts[i] * widths / 12.0), 1.0, 1e-3) << i;
  }
}

TEST(Dequantization, PixelsAreWhatTheFilterSaysWithinTheirLayers) {
  const std::vector<LayerLevel> levels{{0.1, 0.15}, {0.2, 0.3}, {0.45, 0.5}, {0.6, 0.9}};
  const std::vector<LayerRange> layers = layer_ranges(levels);
  for (const double wave : {9.0, 30.0, 200.0, 2000.0}) {
    const Image shown = quantized(waves(131, 70, wave), levels);
    const LayerFilter filter = layer_filter(shown, layers);
    Image smooth = shown;
    dequantize(smooth, layers);
    for (int y = 0; y < shown.height; ++y) {
      for (int x = 0; x < shown.width; ++x) {
        double value = shown.at(x, y);
        const std::array<double, 5> own = differences(shown, filter.stride, x, y);
        for (std::size_t i = 0; i < 5; ++i) value += filter.weights[i] * own[i];
        const auto layer = std::ranges::find(layers, shown.at(x, y), &LayerRange::shown);
        ASSERT_NE(layer, layers.end());
        value = std::clamp(value, double{layer->lo}, double{layer->hi});
        ASSERT_NEAR(smooth.at(x, y), value, 2e-5) << wave << ' ' << x << ' ' << y;
      }
    }
  }
}

TEST(Dequantization, SmoothPicturesComeNearerAndNoiseGetsNoWorse) {
  for (const int levels : {4, 8, 16, 32}) {
    EXPECT_GT(gain_db(waves(256, 256, 100.0), uniform(levels)), 2.0) << levels;
    EXPECT_GE(gain_db(waves(256, 256, 4000.0), uniform(levels)), 0.0) << levels;
    EXPECT_GT(gain_db(noise(256, 256), uniform(levels)), -0.05) << levels;
  }
}

TEST(Dequantization, WideLayersAreFilteredInLargerSteps) {
  const std::vector<LayerLevel> levels = uniform(6);
  int before = 0;
  for (const double wave : {20.0, 120.0, 480.0, 2000.0}) {
    const int stride =
        layer_filter(quantized(waves(256, 256, wave), levels), layer_ranges(levels)).stride;
    EXPECT_GE(stride, before);
    before = stride;
  }
  EXPECT_GT(before, 1);
}

TEST(Dequantization, LevelsAHairApartKeepTheirPixels) {
  std::vector<LayerLevel> levels{{0.5, 0.5}};
  for (int k = 1; k < 200; ++k) levels.push_back({0.5 + 1e-6 * k, 0.5 + 1e-6 * (k + 0.5)});
  const std::vector<LayerRange> layers = layer_ranges(levels);
  const Image shown = quantized(waves(64, 64, 20.0), levels);
  Image smooth = shown;
  dequantize(smooth, layers);
  for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
    const auto layer = std::ranges::find(layers, shown.pixels[i], &LayerRange::shown);
    ASSERT_NE(layer, layers.end());
    EXPECT_GE(smooth.pixels[i], layer->lo);
    EXPECT_LE(smooth.pixels[i], layer->hi);
  }
}

TEST(Dequantization, FlatAndTinyPicturesStayAsTheyAre) {
  const std::vector<LayerRange> layers = layer_ranges(uniform(3));
  for (const auto& [width, height] :
       {std::pair{1, 1}, {1, 9}, {9, 1}, {3, 5}, {33, 65}, {0, 0}, {4096, 1}}) {
    for (const float value : {0.0F, static_cast<float>(1.0 / 3.0), 1.0F}) {
      Image image = make_image(width, height);
      std::ranges::fill(image.pixels, value);
      const Image before = image;
      dequantize(image, layers);
      EXPECT_EQ(image.pixels, before.pixels) << width << " x " << height;
    }
  }
}

TEST(Dequantization, OddSizesHaveNoSeams) {
  // The same picture, cut off at any column: what lies more than the filter's reach inside is the
  // same for the same weights, so a seam would show as a pixel outside its neighbours' range.
  const std::vector<LayerLevel> levels = uniform(8);
  for (int width = 1; width <= 70; ++width) {
    const Image truth = waves(width, 7, 25.0);
    Image smooth = quantized(truth, levels);
    dequantize(smooth, layer_ranges(levels));
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
      ASSERT_NEAR(smooth.pixels[i], truth.pixels[i], 0.126) << width;
    }
  }
}

TEST(Dequantization, ValuesOfNoLayerStay) {
  Image image = quantized(waves(40, 40, 30.0), uniform(5));
  image.at(20, 20) = 0.4321F;
  dequantize(image, layer_ranges(uniform(5)));
  EXPECT_EQ(image.at(20, 20), 0.4321F);
}

TEST(Dequantization, FixedBackgroundStaysBlack) {
  Image image = make_image(40, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 20; x < 40; ++x) image.at(x, y) = x < 24 ? 0.5F : 1.0F;
  }
  Image free = image;
  const std::vector<LayerRange> layers = layer_ranges(uniform(2));
  dequantize(free, layers);
  EXPECT_GT(free.at(19, 20), 0.0F);
  std::vector<std::uint8_t> fixed(image.pixels.size(), 1);
  dequantize(image, layers, fixed);
  EXPECT_EQ(image.at(19, 20), 0.0F);
  EXPECT_EQ(image.at(21, 20), free.at(21, 20));
}

TEST(Dequantization, RowsMayRunInAnyOrder) {
  const std::vector<LayerRange> layers = layer_ranges(uniform(9));
  const Image shown = quantized(waves(203, 311, 33.0), uniform(9));
  Image forwards = shown;
  Image backwards = shown;
  dequantize(forwards, layers);
  dequantize(backwards, layers, {}, [](int count, const std::function<void(int)>& row) {
    for (int i = count; i-- > 0;) row(i);
  });
  EXPECT_EQ(forwards.pixels, backwards.pixels);
}

}  // namespace
}  // namespace nacre
