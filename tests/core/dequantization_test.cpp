// Maxima between the levels: the filter solves its equations, pixels stay in their layers, errors
// shrink, more with more rays a pixel, and nothing depends on the order of rows.
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

/// Of an estimate from so many rays a pixel along each axis beside the layers alone.
double gain_db(const Image& truth, std::span<const LayerLevel> levels, int per_pixel = 1) {
  const Image exact = middle_samples(truth, per_pixel);
  const Image flat = quantized(exact, levels);
  DequantizationMemory memory;
  Image estimate;
  dequantize(quantized(truth, levels), per_pixel, layer_ranges(levels), {}, {}, memory, estimate);
  return 20.0 * std::log10(rmse(exact, flat) / rmse(exact, estimate));
}

/// The number of each sample's layer.
template <class Rank>
std::vector<Rank> ranks_of(const Image& shown, std::span<const LayerRange> layers) {
  std::vector<Rank> ranks;
  for (const float pixel : shown.pixels) {
    const auto layer = std::ranges::find(layers, pixel, &LayerRange::shown);
    EXPECT_NE(layer, layers.end());
    ranks.push_back(static_cast<Rank>(layer - layers.begin()));
  }
  return ranks;
}

using Bytes = std::vector<std::uint8_t>;

LayerSamples<std::uint8_t> samples_of(const Image& shown, const Bytes& ranks, int per_pixel = 1) {
  return {shown.width / per_pixel, shown.height / per_pixel, per_pixel, ranks};
}

/// The class of neighbours so many steps aside and below.
std::size_t class_of(int dx, int dy) {
  constexpr std::array<int, 5> kSquares{1, 2, 4, 5, 8};
  const auto found = std::ranges::find(kSquares, dx * dx + dy * dy);
  return static_cast<std::size_t>(found - kSquares.begin());
}

/// The rank of a sample, or of the nearest within the picture.
int rank_at(const LayerSamples<std::uint8_t>& samples, int x, int y) {
  const int width = samples.width * samples.per_pixel;
  x = std::clamp(x, 0, width - 1);
  y = std::clamp(y, 0, samples.height * samples.per_pixel - 1);
  return samples.ranks[static_cast<std::size_t>(y * width + x)];
}

int middle(const LayerSamples<std::uint8_t>& samples, int pixel) {
  return pixel * samples.per_pixel + samples.per_pixel / 2;
}

/// The differences of the samples around a pixel's centre to it, by class, one at a time.
std::array<double, 5> differences(const LayerSamples<std::uint8_t>& samples, int stride, int x,
                                  int y) {
  std::array<double, 5> sums{};
  const int column = middle(samples, x);
  const int row = middle(samples, y);
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      if (dx == 0 && dy == 0) continue;
      sums[class_of(dx, dy)] +=
          rank_at(samples, column + stride * dx, row + stride * dy) - rank_at(samples, column, row);
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

/// What the normal equations leave of a filter, in parts of their right sides.
std::array<double, 5> residuals(const LayerSamples<std::uint8_t>& samples,
                                const LayerFilter& filter) {
  std::array<std::array<double, 5>, 5> products{};
  std::array<std::array<double, 5>, 5> squares{};  // by how far aside (from -2) and below
  double pixels = 0.0;
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      const int column = middle(samples, x);
      const int row = middle(samples, y);
      const int here = rank_at(samples, column, row);
      if (here == 0) continue;
      pixels += 1.0;
      const std::array<double, 5> own = differences(samples, filter.stride, x, y);
      for (std::size_t i = 0; i < 5; ++i) {
        for (std::size_t j = 0; j < 5; ++j) products[i][j] += own[i] * own[j];
      }
      for (int dy = 0; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          const int there = rank_at(samples, column + filter.stride * dx, row + filter.stride * dy);
          squares[std::size_t(dx + 2)][std::size_t(dy)] += std::pow(there - here, 2);
        }
      }
    }
  }
  std::array<double, 5> right{};
  for (int dy = 0; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      if (dy == 0 && dx <= 0) continue;
      const double mean = squares[std::size_t(dx + 2)][std::size_t(dy)] / pixels;
      const double slope = mean < 0.5 ? mean * (1.0 - mean) / 2.0 : 1.0;
      right[class_of(dx, dy)] += 2.0 * pixels * std::min(slope, 1.0 / 12.0);
    }
  }
  std::array<double, 5> rest{};
  for (std::size_t i = 0; i < 5; ++i) {
    rest[i] = 0.2 * pixels * filter.weights[i] - right[i];
    for (std::size_t j = 0; j < 5; ++j) rest[i] += products[i][j] * filter.weights[j];
    rest[i] /= right[i];
  }
  return rest;
}

TEST(Dequantization, WeightsSolveTheNormalEquations) {
  const std::vector<LayerRange> layers = layer_ranges(uniform(12));
  for (const int per_pixel : {1, 3, 5}) {
    int widest = 0;
    for (const double wave : {15.0, 37.0, 150.0, 700.0, 3000.0}) {
      const Image shown =
          quantized(waves(97 * per_pixel, 61 * per_pixel, wave * per_pixel), uniform(12));
      const Bytes ranks = ranks_of<std::uint8_t>(shown, layers);
      const LayerSamples<std::uint8_t> samples = samples_of(shown, ranks, per_pixel);
      const LayerFilter filter = layer_filter(samples);
      widest = std::max(widest, filter.stride);
      for (const double rest : residuals(samples, filter)) {
        EXPECT_NEAR(rest, 0.0, 1e-9) << per_pixel << ' ' << wave;
      }
    }
    EXPECT_GT(widest, 2);
  }
}

/// Emission of a layer so far from its middle, in layers.
double emission_at(const LayerRange& layer, double away) {
  const double part = std::clamp(2.0 * away, -1.0, 1.0);
  return double{layer.shown} + part * (part < 0.0 ? double{layer.shown} - double{layer.lo}
                                                  : double{layer.hi} - double{layer.shown});
}

TEST(Dequantization, PixelsAreWhatTheFilterSaysWithinTheirLayers) {
  const std::vector<LayerLevel> levels{{0.1, 0.15}, {0.2, 0.3}, {0.45, 0.5}, {0.6, 0.9}};
  const std::vector<LayerRange> layers = layer_ranges(levels);
  for (const int per_pixel : {1, 3, 5}) {
    int widest = 0;
    for (const int width : {1, 2, 3, 31, 32, 33, 67, 131}) {
      for (const double wave : {9.0, 30.0, 200.0, 2000.0, 9000.0}) {
        const Image shown = quantized(waves(width * per_pixel, 70 * per_pixel, wave), levels);
        const Bytes ranks = ranks_of<std::uint8_t>(shown, layers);
        const LayerSamples<std::uint8_t> samples = samples_of(shown, ranks, per_pixel);
        const LayerFilter filter = layer_filter(samples);
        widest = std::max(widest, filter.stride);
        Image smooth;
        dequantize(samples, layers, {}, {}, smooth);
        for (int y = 0; y < samples.height; ++y) {
          for (int x = 0; x < samples.width; ++x) {
            double away = 0.0;
            const std::array<double, 5> own = differences(samples, filter.stride, x, y);
            for (std::size_t i = 0; i < 5; ++i) away += filter.weights[i] * own[i];
            const int rank = rank_at(samples, middle(samples, x), middle(samples, y));
            ASSERT_NEAR(smooth.at(x, y), emission_at(layers[std::size_t(rank)], away), 2e-5)
                << per_pixel << ' ' << width << ' ' << wave << ' ' << x << ' ' << y;
          }
        }
      }
    }
    EXPECT_GE(widest, 16) << per_pixel;
  }
}

TEST(Dequantization, PicturesOfRepresentativesAreThoseOfTheirLayers) {
  const std::vector<LayerLevel> levels{{0.1, 0.15}, {0.2, 0.3}, {0.45, 0.5}, {0.6, 0.9}};
  const std::vector<LayerRange> layers = layer_ranges(levels);
  const Image shown = quantized(waves(3 * 83, 3 * 41, 90.0), levels);
  const Bytes ranks = ranks_of<std::uint8_t>(shown, layers);
  const auto words = ranks_of<std::uint16_t>(shown, layers);
  Image of_bytes;
  Image of_words;
  Image of_picture;
  DequantizationMemory memory;
  dequantize(samples_of(shown, ranks, 3), layers, {}, {}, of_bytes);
  dequantize(LayerSamples<std::uint16_t>{83, 41, 3, words}, layers, {}, {}, of_words);
  dequantize(shown, 3, layers, {}, {}, memory, of_picture);
  EXPECT_EQ(of_bytes.pixels, of_words.pixels);
  EXPECT_EQ(of_bytes.pixels, of_picture.pixels);
  EXPECT_NE(of_bytes.pixels, middle_samples(shown, 3).pixels);
}

// Where layers are a pixel wide or less; where they are wide, pixels tell as much.
TEST(Dequantization, MoreRaysAPixelTellMore) {
  for (const int levels : {6, 12, 24}) {
    for (const double wave : {8.0, 14.0, 150.0}) {
      const double one = gain_db(waves(200, 200, wave), uniform(levels));
      const double nine = gain_db(waves(600, 600, 3.0 * wave), uniform(levels), 3);
      EXPECT_GT(nine, wave < 100.0 ? one + 1.0 : one - 1.0) << levels << ' ' << wave;
      EXPECT_GT(nine, 2.0) << levels << ' ' << wave;
    }
  }
}

TEST(Dequantization, TheMiddleOfAPixelIsThePixel) {
  const Image samples = waves(15, 9, 20.0);
  const Image pixels = middle_samples(samples, 3);
  ASSERT_EQ(pixels.width, 5);
  ASSERT_EQ(pixels.height, 3);
  EXPECT_EQ(pixels.at(4, 2), samples.at(13, 7));
  EXPECT_EQ(middle_samples(samples, 1).pixels, samples.pixels);
}

/// A straight vessel with a profile, a cone and a pyramid: pictures that vary in few ways.
std::vector<Image> simple_shapes(double radius) {
  std::vector<Image> shapes(6, make_image(300, 300));
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 300; ++x) {
      const double dx = std::abs(x - 150.3);
      const double dy = std::abs(y - 148.8);
      const double aslant = std::abs(x - y + 4.7) / std::sqrt(2.0);
      const auto linear = [&](double distance) { return std::max(0.0, 1.0 - distance / radius); };
      const std::array<double, 6> values{dx < 120.0 ? linear(dy) : 0.0,
                                         dy < 120.0 ? linear(dx) : 0.0,
                                         std::abs(x + y - 300.0) < 170.0 ? linear(aslant) : 0.0,
                                         linear(std::hypot(dx, dy)),
                                         linear(std::max(dx, dy)),
                                         std::exp(-dy * dy / (radius * radius))};
      for (std::size_t i = 0; i < 6; ++i) shapes[i].at(x, y) = static_cast<float>(values[i]);
    }
  }
  return shapes;
}

TEST(Dequantization, StraightVesselsConesAndPyramidsComeNearer) {
  for (const double radius : {10.0, 40.0, 110.0}) {
    int shape = 0;
    for (const Image& truth : simple_shapes(radius)) {
      for (const int levels : {6, 12, 24}) {
        for (const int per_pixel : {1, 3}) {
          EXPECT_GT(gain_db(truth, uniform(levels), per_pixel), 0.0)
              << radius << ' ' << shape << ' ' << levels << ' ' << per_pixel;
        }
      }
      ++shape;
    }
  }
}

// Their covariances are those of one dimension.
TEST(Dequantization, StripesStayFinite) {
  const std::vector<LayerLevel> levels = uniform(14);
  const std::vector<LayerRange> layers = layer_ranges(levels);
  for (const bool across : {false, true}) {
    Image image = across ? make_image(256, 2048) : make_image(2048, 256);
    const std::array<int, 11> layer_of{2, 6, 5, 0, 1, 1, 11, 5, 7, 11, 9};
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const auto stripe = static_cast<std::size_t>(across ? x : y) % layer_of.size();
        image.at(x, y) = layers[static_cast<std::size_t>(layer_of[stripe])].shown;
      }
    }
    const Bytes ranks = ranks_of<std::uint8_t>(image, layers);
    for (const double weight : layer_filter(samples_of(image, ranks)).weights) {
      EXPECT_LT(std::abs(weight), 1.0);
    }
    dequantize(image, layers);
    EXPECT_TRUE(std::ranges::all_of(image.pixels, [](float v) { return v >= 0.0F && v <= 1.0F; }));
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
    const Image shown = quantized(waves(256, 256, wave), levels);
    const Bytes ranks = ranks_of<std::uint8_t>(shown, layer_ranges(levels));
    const int stride = layer_filter(samples_of(shown, ranks)).stride;
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
