#include "io/dicom_slice.h"

#include <fmt/core.h>
#include <gdcmAttribute.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

#include "io/bad_file.h"
#include "io/data_files.h"
#include "io/dicom_magic.h"
#include "io/number_list.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

const gdcm::Tag kPixelData(0x7fe0, 0x0010);

/// The text of an element without padding; empty if it is absent.
std::string text_of(const gdcm::DataSet& data, const gdcm::Tag& tag) {
  if (!data.FindDataElement(tag)) return {};
  const gdcm::ByteValue* value = data.GetDataElement(tag).GetByteValue();
  if (value == nullptr || value->GetPointer() == nullptr) return {};
  std::string text(value->GetPointer(), value->GetLength());
  text.resize(std::min(text.size(), text.find('\0')));
  return std::string(trimmed(text));
}

/// `count` decimal numbers of an element; nothing if it is absent or holds anything else.
std::optional<std::vector<double>> numbers_of(const gdcm::DataSet& data, const gdcm::Tag& tag,
                                              std::size_t count) {
  std::vector<double> numbers;
  const std::string text = text_of(data, tag);
  for (std::string_view part : split(text, '\\')) {
    part = trimmed(part);
    if (part.starts_with('+')) part.remove_prefix(1);
    const auto number = parse_number<double>(part);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

double number_or(const gdcm::DataSet& data, const gdcm::Tag& tag, double otherwise) {
  const auto numbers = numbers_of(data, tag, 1);
  return numbers ? numbers->front() : otherwise;
}

template <std::uint16_t Group, std::uint16_t Element>
int integer_or(const gdcm::DataSet& data, int otherwise) {
  gdcm::Attribute<Group, Element> attribute;
  const gdcm::Tag tag(Group, Element);
  if (!data.FindDataElement(tag) || data.GetDataElement(tag).IsEmpty()) return otherwise;
  attribute.SetFromDataSet(data);
  return static_cast<int>(attribute.GetValue());
}

void read_frame(const gdcm::DataSet& data, DicomSlice& slice) {
  const auto position = numbers_of(data, gdcm::Tag(0x0020, 0x0032), 3);
  const auto directions = numbers_of(data, gdcm::Tag(0x0020, 0x0037), 6);
  const auto spacing = numbers_of(data, gdcm::Tag(0x0028, 0x0030), 2);
  slice.has_position = position && directions && spacing;
  if (!slice.has_position) return;
  const std::vector<double>& p = *position;
  const std::vector<double>& d = *directions;
  slice.position = {p[0], p[1], p[2]};
  slice.x_direction = {d[0], d[1], d[2]};
  slice.y_direction = {d[3], d[4], d[5]};
  // PixelSpacing gives the distance of rows first: that is along y.
  slice.spacing_mm = {(*spacing)[1], (*spacing)[0]};
  slice.thickness_mm = number_or(data, gdcm::Tag(0x0018, 0x0050), 0.0);
}

DicomSlice describe(const fs::path& path, const gdcm::DataSet& data) {
  DicomSlice slice;
  slice.path = path;
  slice.series_uid = text_of(data, gdcm::Tag(0x0020, 0x000e));
  slice.rows = integer_or<0x0028, 0x0010>(data, 0);
  slice.columns = integer_or<0x0028, 0x0011>(data, 0);
  slice.samples_per_pixel = integer_or<0x0028, 0x0002>(data, 1);
  slice.photometric = text_of(data, gdcm::Tag(0x0028, 0x0004));
  slice.bits_allocated = integer_or<0x0028, 0x0100>(data, 0);
  slice.bits_stored = integer_or<0x0028, 0x0101>(data, slice.bits_allocated);
  slice.high_bit = integer_or<0x0028, 0x0102>(data, slice.bits_stored - 1);
  slice.is_signed = integer_or<0x0028, 0x0103>(data, 0) != 0;
  slice.frames = static_cast<std::int64_t>(number_or(data, gdcm::Tag(0x0028, 0x0008), 1.0));
  // Enhanced images keep their frame in a sequence, even where there is one frame only.
  if (data.FindDataElement(gdcm::Tag(0x5200, 0x9230)) && slice.frames < 2) slice.frames = 2;
  slice.has_lookup_table = data.FindDataElement(gdcm::Tag(0x0028, 0x3000));
  slice.slope = number_or(data, gdcm::Tag(0x0028, 0x1053), 1.0);
  slice.intercept = number_or(data, gdcm::Tag(0x0028, 0x1052), 0.0);
  read_frame(data, slice);
  return slice;
}

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

/// Runs GDCM on a file: silent, and with whatever it throws as one line of ours.
template <class Work>
auto guarded(const fs::path& path, Work work) {
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  try {
    return work();
  } catch (const std::exception&) {
    // Its allocations follow lengths in the file, so that std::bad_alloc means damage here too.
  }
  throw_bad_file(path, "a damaged DICOM file", "one that can be decoded");
}

}  // namespace

std::optional<DicomSlice> read_dicom_slice(const fs::path& path) {
  const bool certainly_dicom = has_dicom_magic(path);
  return guarded(path, [&]() -> std::optional<DicomSlice> {
    gdcm::Reader reader;
    reader.SetFileName(path.c_str());
    if (!certainly_dicom && !reader.CanRead()) return std::nullopt;
    if (!reader.ReadUpToTag(kPixelData)) {
      if (!certainly_dicom) return std::nullopt;
      throw std::runtime_error("unreadable");
    }
    const gdcm::DataSet& data = reader.GetFile().GetDataSet();
    const bool image = data.FindDataElement(gdcm::Tag(0x0028, 0x0010)) &&
                       data.FindDataElement(gdcm::Tag(0x0020, 0x000e));
    if (!image) return std::nullopt;
    return describe(path, data);
  });
}

void read_dicom_samples(const DicomSlice& slice, std::span<std::byte> samples) {
  const bool decoded = guarded(slice.path, [&] {
    gdcm::ImageReader reader;
    reader.SetFileName(slice.path.c_str());
    if (!reader.Read()) return false;
    const gdcm::Image& image = reader.GetImage();
    return image.GetBufferLength() == samples.size() &&
           image.GetBuffer(reinterpret_cast<char*>(samples.data()));
  });
  if (!decoded) {
    throw_bad_file(
        slice.path, "samples that cannot be decoded or are not as many",
        fmt::format("{} x {} samples of {} bits", slice.columns, slice.rows, slice.bits_allocated));
  }
  fill_unused_bits(samples, slice);
}

}  // namespace nacre
