#include "io/dicom_slice.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include "io/bad_file.h"
#include "io/child_process.h"
#include "io/dicom_magic.h"
#include "io/gdcm_module.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

template <class Word>
void fill_unused_bits(std::span<std::byte> samples, const DicomSlice& slice) {
  const int unused = static_cast<int>(8 * sizeof(Word)) - slice.bits_stored;
  if (unused <= 0) return;
  for (std::size_t begin = 0; begin + sizeof(Word) <= samples.size(); begin += sizeof(Word)) {
    Word word{};
    std::memcpy(&word, samples.data() + begin, sizeof(Word));
    word =
        static_cast<Word>(static_cast<Word>(word << unused) >> unused);  // signed: keeps the sign
    std::memcpy(samples.data() + begin, &word, sizeof(Word));
  }
}

void fill_unused_bits(std::span<std::byte> samples, const DicomSlice& slice) {
  switch (slice.bits_allocated) {
    case 8:
      slice.is_signed ? fill_unused_bits<std::int8_t>(samples, slice)
                      : fill_unused_bits<std::uint8_t>(samples, slice);
      break;
    case 16:
      slice.is_signed ? fill_unused_bits<std::int16_t>(samples, slice)
                      : fill_unused_bits<std::uint16_t>(samples, slice);
      break;
    default:
      slice.is_signed ? fill_unused_bits<std::int32_t>(samples, slice)
                      : fill_unused_bits<std::uint32_t>(samples, slice);
  }
}

/// What GDCM may allocate: room for a whole file and for itself.
std::size_t memory_for(const std::vector<fs::path>& files) {
  constexpr std::size_t own = std::size_t{128} << 20;
  std::uintmax_t largest = 0;
  std::error_code ignored;
  for (const fs::path& file : files) largest = std::max(largest, fs::file_size(file, ignored));
  return own + 2 * static_cast<std::size_t>(largest);
}

/// What a child says about each file, as bytes. Trivially copyable: the child is a copy of us.
struct Finding {
  bool has_image = false;
  DicomSlice slice;
};
static_assert(std::is_trivially_copyable_v<Finding>);

}  // namespace

std::vector<std::optional<DicomSlice>> read_dicom_slices(const std::vector<fs::path>& files) {
  std::vector<std::optional<DicomSlice>> slices;
  const GdcmModule gdcm = load_gdcm();
  while (slices.size() < files.size()) {
    const std::size_t begin = slices.size();
    ChildProcess child(memory_for(files), [&](const ByteSink& sink) {
      for (std::size_t i = begin; i < files.size(); ++i) {
        Finding finding;
        finding.has_image =
            gdcm.describe(files[i].c_str(), has_dicom_magic(files[i]), &finding.slice);
        sink(std::as_bytes(std::span(&finding, 1)));
      }
    });
    Finding finding;
    while (slices.size() < files.size() &&
           child.read(std::as_writable_bytes(std::span(&finding, 1)))) {
      slices.push_back(finding.has_image ? std::optional(finding.slice) : std::nullopt);
    }
    if (slices.size() == files.size()) break;
    // The child ended at this file: damaged, or none of GDCM's business. Go on behind it.
    const fs::path& culprit = files[slices.size()];
    if (has_dicom_magic(culprit)) {
      throw_bad_file(culprit, "a damaged DICOM file", "one that can be decoded");
    }
    slices.emplace_back();
  }
  return slices;
}

void read_dicom_samples(const std::vector<fs::path>& files, const DicomSlice& slice,
                        std::span<std::byte> samples) {
  const std::size_t size = samples.size() / files.size();
  const GdcmModule gdcm = load_gdcm();
  // The library holds a slice several times while it decodes it.
  ChildProcess child(memory_for(files) + 8 * size, [&](const ByteSink& sink) {
    std::vector<std::byte> decoded(size);
    for (const fs::path& file : files) {
      gdcm.decode(file.c_str(), decoded.data(), decoded.size());
      sink(decoded);
    }
  });
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (child.read(samples.subspan(i * size, size))) continue;
    throw_bad_file(
        files[i], "samples that cannot be decoded or are not as many",
        fmt::format("{} x {} samples of {} bits", slice.columns, slice.rows, slice.bits_allocated));
  }
  fill_unused_bits(samples, slice);
}

}  // namespace nacre
