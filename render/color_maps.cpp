#include "render/color_maps.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <glm/common.hpp>

#include "core/error.h"

namespace nacre {
namespace {

constexpr std::string_view kViridis{
    "440154450559460a5d470e61471365481769481b6d481f70482374482677472a7a472e7c46327e453581443983"
    "433d844240864144873f47883e4a893d4e8a3b518b3a548c38588c375b8d355e8d34618d32648e31678e306a8e"
    "2e6d8e2d708e2c728e2b758e2a788e297b8e277e8e26818e25838e24868e23898e228c8d218f8d20928c1f948c"
    "1f978b1f9a8a1e9d891fa0881fa28721a58522a88425ab8227ad812ab07f2eb37c32b67a37b8783bbb7540bd72"
    "46c06f4cc26c52c56958c7655ec96265cb5e6ccd5a73d0567ad15181d34d89d54890d74398d83ea0da39a8db34"
    "b0dd2fb8de29c0df25c8e020d0e11cd8e219dfe318e7e419efe51cf6e620fde725"};
constexpr std::string_view kInferno{
    "00000401010802020e04031407051b0a07220d0829110a30150b37190c3e1e0c45230c4c280b532d0b59320a5e"
    "3809623d0965420a68470b6a4c0c6b510e6c550f6d5a116e5f136e64156e69166e6d186e721a6e771c6d7c1d6d"
    "801f6c85216b8a226a8f24699326679827669d2964a22b62a62d60ab2f5eb0315bb43359b93556bd3853c13a50"
    "c63d4dca404ace4347d24644d54a41d94d3ddd513ae05536e35933e65d2fe9612beb6628ee6a24f06f20f2741c"
    "f47918f67e14f78410f8890cf98e09fa9407fb9906fc9f07fca50afcaa0ffcb014fbb61afbbc21fac228f9c72f"
    "f8cd37f7d340f5d949f4df53f3e55df2ea69f1ef75f2f482f4f88ef8fb9afcffa4"};
constexpr std::string_view kMagma{
    "00000401010802020d04041406051a0907200c0926100b2d130d34160f3b1a10421e11492211502712582c115f"
    "31116536106b3b0f70400f744510774a10794f127b54137d59157e5d177f621980671b806b1d81701f81752181"
    "7922827e24828326818827818c2981912b81962c809b2e7fa02f7fa5317eaa337dae347bb3367ab83779bd3977"
    "c23b75c73d73cc3f71d0416fd5446dd9466bde4968e24d66e55064e95462ec5860ef5d5ef2625df4675cf66c5c"
    "f7725cf9785dfa7d5efb835ffc8961fc8e64fd9467fd9a6afe9f6dfea571feaa74feb078feb67cfebb81fec185"
    "fec68afecc8ffed194fed799fddc9efde2a3fde7a9fcecaefcf2b4fcf7b9fcfdbf"};
constexpr std::string_view kPlasma{
    "0d088716078a1d068e2406912a05932f05963504983a049a3f049c44039e4903a04e02a25302a35801a45c01a6"
    "6100a76600a76a00a86f00a87401a87801a87d03a88104a78606a68a09a58e0ca4920fa39613a19a169f9e199d"
    "a21d9aa62098aa2395ad2793b12a90b42e8db7318abb3488be3885c13b82c43e7fc7427cca457acc4977cf4c74"
    "d24f71d5536fd7566cda5a6adc5d67de6164e16462e3685fe56b5de76f5ae97257eb7655ed7a52ef7e50f1814d"
    "f3854bf48948f68d45f79143f89540f99a3efa9e3bfba238fca636fdab33fdaf31fdb42ffeb82cfebd2afdc229"
    "fdc627fdcb26fcd025fbd524fada24f8df25f7e425f5e926f3ee27f1f426f0f921"};
constexpr std::string_view kCividis{
    "00224e00255300275800295d002b62002d68002f6d0031700533710f35701637701c396f213b6e263d6e2a3f6d"
    "2e416d32436d35456c39486c3c4a6c3f4c6c424e6c45506c48526c4b546c4e566c51586d545a6d565c6d595e6e"
    "5c616e5e636f61656f646770666970696b716c6d726e6f737172747374757676767878777b7a787e7c78807f78"
    "8381798683798985788c88788f8a78928c78948e779791779a93769d9576a09875a39a74a69c74a99f73aca172"
    "afa471b3a670b6a96fb9ab6dbcae6cbfb06bc2b369c5b568c8b866ccba64cfbd62d2c060d5c25ed9c55cdcc859"
    "dfca57e2cd54e6d051e9d34eedd54af0d846f3db42f7de3efbe138fee434fee838"};
// Black, dark red, red, skin, ivory.
constexpr std::string_view kAngio{"0000003b05087d0f10bf2a1ce7603cf4a076fad4b4fffff0"};

/// Entry `i` of a table of rrggbb.
glm::dvec3 entry(std::string_view table, std::size_t i) {
  unsigned rgb = 0;
  std::from_chars(table.data() + 6 * i, table.data() + 6 * i + 6, rgb, 16);
  return glm::dvec3(rgb >> 16 & 0xffU, rgb >> 8 & 0xffU, rgb & 0xffU) / 255.0;
}

/// Evenly spaced colours, linear between them.
glm::dvec3 in_table(std::string_view table, double brightness) {
  const std::size_t intervals = table.size() / 6 - 1;
  const double at = std::clamp(brightness, 0.0, 1.0) * static_cast<double>(intervals);
  const std::size_t i = std::min(static_cast<std::size_t>(at), intervals - 1);
  return glm::mix(entry(table, i), entry(table, i + 1), at - static_cast<double>(i));
}

/// How far `t` is on the way from `begin` to `end`, 0 to 1.
double progress(double t, double begin, double end) {
  return std::clamp((t - begin) / (end - begin), 0.0, 1.0);
}

glm::dvec3 gray(double t) { return glm::dvec3(t); }
glm::dvec3 gray_inverted(double t) { return glm::dvec3(1.0 - t); }
/// Each channel rises over its own third.
glm::dvec3 hot(double t) {
  return glm::clamp(glm::dvec3(3.0 * t, 3.0 * t - 1.0, 3.0 * t - 2.0), 0.0, 1.0);
}
glm::dvec3 hot_iron(double t) {
  return {progress(t, 0.0, 0.5), progress(t, 0.5, 1.0), progress(t, 0.75, 1.0)};
}
/// Each channel is steeper, by 1/8 in all, where `hot` moves it.
glm::dvec3 bone(double t) {
  return (7.0 * glm::dvec3(t) + glm::dvec3(progress(t, 0.746032, 1.0),
                                           progress(t, 0.365079, 0.746032),
                                           progress(t, 0.0, 0.365079))) /
         8.0;
}
glm::dvec3 angio(double t) { return in_table(kAngio, t); }
glm::dvec3 viridis(double t) { return in_table(kViridis, t); }
glm::dvec3 inferno(double t) { return in_table(kInferno, t); }
glm::dvec3 magma(double t) { return in_table(kMagma, t); }
glm::dvec3 plasma(double t) { return in_table(kPlasma, t); }
glm::dvec3 cividis(double t) { return in_table(kCividis, t); }

using ColorFunction = glm::dvec3 (*)(double);

constexpr std::array<std::string_view, 11> kNames{"gray",  "gray-inverted", "hot",     "hot-iron",
                                                  "bone",  "angio",         "viridis", "inferno",
                                                  "magma", "plasma",        "cividis"};
constexpr std::array<ColorFunction, 11> kFunctions{
    gray, gray_inverted, hot, hot_iron, bone, angio, viridis, inferno, magma, plasma, cividis};

ColorFunction function_of(std::string_view name) {
  const auto* const found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("colour map: found '{}', expected {}", name, color_map_list()));
  }
  return kFunctions[static_cast<std::size_t>(found - kNames.begin())];
}

}  // namespace

std::span<const std::string_view> color_map_names() { return kNames; }

std::string color_map_list() {
  std::string list(kNames.front());
  for (std::size_t i = 1; i < kNames.size(); ++i) {
    list += fmt::format("{}{}", i + 1 < kNames.size() ? ", " : " or ", kNames[i]);
  }
  return list;
}

ColorMap::ColorMap(std::string_view name)
    : color_(function_of(name)),
      gray_(name.starts_with("gray")),
      inverted_(name == "gray-inverted") {}

}  // namespace nacre
