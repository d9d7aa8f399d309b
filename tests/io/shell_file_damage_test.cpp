#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "core/checksum.h"
#include "core/error.h"
#include "io/shell_reader.h"
#include "io/shell_writer.h"
#include "tests/io/small_shell_set.h"
#include "tests/support/analytic_surfaces.h"

namespace nacre {
namespace {

using Bytes = std::vector<std::byte>;
using nlohmann::ordered_json;
using testing::on_grid;
using testing::small_shell_set;
using testing::sphere_surface;
using testing::torus_surface;

constexpr const char* kName = "damaged.glb";
constexpr std::size_t kJsonStart = 20;

/// How many random variants a test tries; NACRE_FUZZ_VARIANTS tries more by hand.
std::size_t variants(std::size_t usual) {
  const char* wanted = std::getenv("NACRE_FUZZ_VARIANTS");
  return wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : usual;
}

std::uint32_t word(const Bytes& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof(value));
  return value;
}

void set_word(Bytes& bytes, std::size_t offset, std::size_t value) {
  const auto narrow = static_cast<std::uint32_t>(value);
  std::memcpy(bytes.data() + offset, &narrow, sizeof(narrow));
}

std::size_t binary_start(const Bytes& file) { return kJsonStart + word(file, 12) + 8; }

ordered_json json_of(const Bytes& file) {
  const auto* text = reinterpret_cast<const char*>(file.data() + kJsonStart);
  return ordered_json::parse(text, text + word(file, 12));
}

/// The file with another JSON text, all lengths right.
Bytes with_json_text(const Bytes& file, std::string text) {
  while (text.size() % 4 != 0) text += ' ';
  const std::size_t rest = kJsonStart + word(file, 12);
  Bytes result(kJsonStart + text.size() + file.size() - rest);
  std::copy_n(file.begin(), kJsonStart, result.begin());
  std::memcpy(result.data() + kJsonStart, text.data(), text.size());
  std::copy(file.begin() + static_cast<std::ptrdiff_t>(rest), file.end(),
            result.begin() + static_cast<std::ptrdiff_t>(kJsonStart + text.size()));
  set_word(result, 8, result.size());
  set_word(result, 12, text.size());
  return result;
}

Bytes with_json(const Bytes& file, const std::function<void(ordered_json&)>& change) {
  ordered_json json = json_of(file);
  change(json);
  return with_json_text(file, json.dump());
}

/// The file with the checksums of its compressed data made right again: what a forger would do, and
/// what lets damage through to Draco.
Bytes restamped(const Bytes& file) {
  return with_json(file, [&](ordered_json& json) {
    for (ordered_json& level : json["nodes"][0]["extras"]["nacre"]["levels"]) {
      if (level["mesh"].is_null()) continue;
      const ordered_json& view = json["bufferViews"][level["mesh"].get<std::size_t>()];
      const std::span<const std::byte> data(
          file.data() + binary_start(file) + view["byteOffset"].get<std::size_t>(),
          view["byteLength"].get<std::size_t>());
      level["checksum"] = checksum_text(xxh64(data));
    }
  });
}

/// The message of a refusal; "" if the file is read.
std::string refusal(const Bytes& file) {
  try {
    decode_shell_set(file, kName);
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).rfind(kName, 0), 0u) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

Bytes small_file() { return encode_shell_set(small_shell_set()); }

/// A single shell of some size: under 1000 triangles Draco writes plain symbols, beyond that
/// entropy-coded ones.
Bytes file_of(const TriangleMesh& surface) {
  ShellSet set = small_shell_set();
  set.shells.resize(1);
  set.shells[0].surface = on_grid(*set.grid, surface);
  return encode_shell_set(set);
}

TEST(DamagedShellFile, CutShortAnywhereIsRefused) {
  const Bytes file = small_file();
  for (std::size_t size = 0; size < file.size(); ++size) {
    Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_NE(refusal(cut), "") << size << " bytes";
    if (size < 12) continue;
    set_word(cut, 8, size);  // a header that agrees
    ASSERT_NE(refusal(cut), "") << size << " bytes";
  }
}

TEST(DamagedShellFile, AnyBitFlippedInTheBinaryChunkIsFound) {
  const Bytes file = small_file();
  const ordered_json json = json_of(file);
  std::mt19937 random(1);
  for (std::size_t i = 0; i < 2000; ++i) {
    const std::size_t level = random() % 3;
    const ordered_json& view = json["bufferViews"][level];
    const std::size_t offset = binary_start(file) + view["byteOffset"].get<std::size_t>() +
                               random() % view["byteLength"].get<std::size_t>();
    Bytes flipped = file;
    flipped[offset] ^= static_cast<std::byte>(1u << (random() % 8));
    ASSERT_NE(refusal(flipped).find("checksum"), std::string::npos);
  }
}

TEST(DamagedShellFile, FlippedBitsAreReadOrRefused) {
  const Bytes file = small_file();
  std::mt19937 random(2);
  for (std::size_t i = 0; i < variants(4000); ++i) {
    Bytes flipped = file;
    const std::size_t flips = 1 + random() % 4;
    for (std::size_t flip = 0; flip < flips; ++flip) {
      flipped[random() % binary_start(file)] ^= static_cast<std::byte>(1u << (random() % 8));
    }
    refusal(flipped);
  }
}

/// Damages compressed data and forges its checksum, so that Draco itself has to cope.
void damage_compressed_data(const Bytes& file, unsigned seed, std::size_t count) {
  std::mt19937 random(seed);
  const std::size_t start = binary_start(file);
  for (std::size_t i = 0; i < count; ++i) {
    Bytes damaged = file;
    const std::size_t changes = 1 + random() % 3;
    for (std::size_t change = 0; change < changes; ++change) {
      // Half of the changes near the beginning, where the counts and tables are.
      const std::size_t reach =
          random() % 2 == 0 ? file.size() - start : std::min<std::size_t>(80, file.size() - start);
      std::byte& byte = damaged[start + random() % reach];
      byte = random() % 2 == 0 ? byte ^ static_cast<std::byte>(1u << (random() % 8))
                               : static_cast<std::byte>(random() % 256);
    }
    refusal(restamped(damaged));
  }
}

TEST(DamagedShellFile, DracoDataWithPlainSymbolsIsReadOrRefused) {
  damage_compressed_data(file_of(torus_surface(4.0f, 1.0f, 12, 8)), 3, variants(2000));
}

TEST(DamagedShellFile, DracoDataWithCodedSymbolsIsReadOrRefused) {
  damage_compressed_data(file_of(torus_surface(4.0f, 1.0f, 32, 17)), 4, variants(1000));
}

/// A file whose JSON is changed must be refused with a message that says where.
void expect_refusal(const std::string& part, const std::function<void(ordered_json&)>& change) {
  const std::string message = refusal(with_json(small_file(), change));
  EXPECT_NE(message.find(part), std::string::npos) << "'" << message << "', expected " << part;
}

ordered_json& extras(ordered_json& json) { return json["nodes"][0]["extras"]["nacre"]; }

TEST(DamagedShellFile, SaysThatAnotherGltfIsNoShellSet) {
  expect_refusal("extras.nacre", [](ordered_json& json) { json["nodes"][0].erase("extras"); });
  expect_refusal("extras.nacre", [](ordered_json& json) { json.erase("nodes"); });
}

TEST(DamagedShellFile, SaysWhereTheDescriptionIsWrong) {
  expect_refusal("levels[1].emission",
                 [](ordered_json& json) { extras(json)["levels"][1]["emission"] = "high"; });
  expect_refusal("ascending", [](ordered_json& json) {
    std::swap(extras(json)["levels"][0], extras(json)["levels"][1]);
  });
  expect_refusal("grid.bits", [](ordered_json& json) { extras(json)["grid"]["bits"] = 31; });
  expect_refusal("exact grid", [](ordered_json& json) { extras(json)["grid"]["range_mm"] = 0.1; });
  expect_refusal("dims", [](ordered_json& json) { extras(json)["volume"]["dims"][1] = -1; });
  expect_refusal("volume.type", [](ordered_json& json) { extras(json)["volume"]["type"] = "u9"; });
  expect_refusal("world_from_voxel", [](ordered_json& json) {
    extras(json)["volume"]["world_from_voxel"][7] = nullptr;
  });
  expect_refusal("emission", [](ordered_json& json) { extras(json)["emission"][1][1] = 2; });
  expect_refusal("placement", [](ordered_json& json) { extras(json)["placement"] = "odd"; });
  expect_refusal("tolerance_weight",
                 [](ordered_json& json) { extras(json)["tolerance_weight"] = "odd"; });
  expect_refusal("checksum", [](ordered_json& json) { extras(json)["volume"]["checksum"] = "0"; });
  expect_refusal("center_mm", [](ordered_json& json) { extras(json).erase("center_mm"); });
}

TEST(DamagedShellFile, SaysThatALaterFormatNeedsALaterProgram) {
  expect_refusal("later nacre", [](ordered_json& json) { extras(json)["format"] = 2; });
}

TEST(DamagedShellFile, PlacesOutsideTheFileAreRefused) {
  expect_refusal("within",
                 [](ordered_json& json) { json["bufferViews"][1]["byteLength"] = 1 << 30; });
  expect_refusal("within", [](ordered_json& json) {
    json["bufferViews"][1]["byteOffset"] = (std::uint64_t{1} << 53) - 8;
  });
  expect_refusal("a count", [](ordered_json& json) {
    json["bufferViews"][1]["byteOffset"] = std::numeric_limits<std::uint64_t>::max();
  });
  expect_refusal("bufferViews[9]", [](ordered_json& json) {
    json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"] =
        9;
  });
  expect_refusal("meshes[77]", [](ordered_json& json) { extras(json)["levels"][0]["mesh"] = 77; });
}

void claim(ordered_json& json, std::size_t triangles, std::size_t vertices) {
  extras(json)["levels"][0]["triangles"] = triangles;
  extras(json)["levels"][0]["vertices"] = vertices;
  json["accessors"][0]["count"] = vertices;
  json["accessors"][1]["count"] = 3 * triangles;
}

// Each would make Draco allocate gigabytes, or read on beyond what there is.
TEST(DamagedShellFile, CountsThatTheBytesCannotHoldAreRefusedBeforeDecoding) {
  expect_refusal("at most", [](ordered_json& json) { claim(json, 1'400'000'000, 7); });
  expect_refusal("at most", [](ordered_json& json) { claim(json, std::size_t{1} << 50, 7); });
  expect_refusal("triangles", [](ordered_json& json) { claim(json, 588, 1'000'000'000); });
  expect_refusal("triangles", [](ordered_json& json) { claim(json, 589, 296); });
  expect_refusal("accessors[0].count",
                 [](ordered_json& json) { json["accessors"][0]["count"] = 1; });
}

/// What reading the coarse copies of a changed file says.
std::string coarse_refusal(const Bytes& file) {
  try {
    decode_shell_set(file, kName, {.coarse = true});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(DamagedShellFile, AnyBitFlippedInACoarseCopyIsFound) {
  const Bytes file = testing::small_file_with_copies();
  const ordered_json view = json_of(file)["bufferViews"][4];  // the second copy
  const std::size_t begin = binary_start(file) + view["byteOffset"].get<std::size_t>();
  std::mt19937 random(7);
  for (std::size_t i = 0; i < 50; ++i) {
    Bytes damaged = file;
    const std::size_t at = begin + random() % view["byteLength"].get<std::size_t>();
    damaged[at] ^= static_cast<std::byte>(1u << (random() % 8));
    EXPECT_NE(coarse_refusal(damaged).find("shell 2: found checksum"), std::string::npos);
    EXPECT_EQ(refusal(damaged), "");  // the shells themselves are whole
  }
}

TEST(DamagedShellFile, SaysWhereCoarseCopiesAreWrong) {
  const Bytes file = testing::small_file_with_copies();
  const auto expect = [&](const std::string& part,
                          const std::function<void(ordered_json&)>& change) {
    const std::string message = refusal(with_json(file, change));
    EXPECT_NE(message.find(part), std::string::npos) << "'" << message << "', expected " << part;
  };
  expect("coarse", [](ordered_json& json) { extras(json).erase("coarse"); });
  expect("coarse.tolerance", [](ordered_json& json) { extras(json)["coarse"]["tolerance"] = -1; });
  expect("meshes[77]",
         [](ordered_json& json) { extras(json)["levels"][0]["coarse"]["mesh"] = 77; });
  expect("levels[0].coarse",
         [](ordered_json& json) { extras(json)["levels"][0]["coarse"] = nullptr; });
  expect("levels[3].coarse", [](ordered_json& json) {
    extras(json)["levels"][3]["coarse"] = extras(json)["levels"][0]["coarse"];
  });
  expect("at most", [](ordered_json& json) {
    extras(json)["levels"][0]["coarse"]["triangles"] = 1'400'000'000;
    json["accessors"][7]["count"] = std::size_t{3} * 1'400'000'000;
  });
}

TEST(DamagedShellFile, DeepOrMalformedJsonIsRefused) {
  EXPECT_NE(refusal(with_json_text(small_file(), std::string(1'000'000, '['))).find("deeper"),
            std::string::npos);
  EXPECT_NE(refusal(with_json_text(small_file(), "{\"asset\":\"\xff\"}")).find("JSON"),
            std::string::npos);
  EXPECT_NE(refusal(with_json_text(small_file(), "")), "");
  EXPECT_NE(refusal(with_json_text(small_file(), "[]")), "");
}

TEST(DamagedShellFile, MissingFilesAndFoldersAreNamed) {
  EXPECT_THROW(read_shell_set("/nonexistent.glb"), Error);
  EXPECT_THROW(read_shell_set(::testing::TempDir()), Error);
  EXPECT_THROW(read_shell_file_info("/dev/null"), Error);
}

}  // namespace
}  // namespace nacre
