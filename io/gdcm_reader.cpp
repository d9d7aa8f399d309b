// The module nacre_gdcm: all that knows GDCM, loaded where a DICOM file is read (see
// gdcm_module.h).
#include <gdcmAttribute.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/dicom_slice.h"
#include "io/gdcm_module.h"
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

/// As much of a text as there is room for, ended by 0.
void copy_text(const std::string& text, std::span<char> to) {
  std::copy_n(text.begin(), std::min(text.size(), to.size() - 1), to.begin());
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

DicomSlice describe(const gdcm::DataSet& data) {
  DicomSlice slice;
  copy_text(text_of(data, gdcm::Tag(0x0020, 0x000e)), slice.series_uid_text);
  slice.rows = integer_or<0x0028, 0x0010>(data, 0);
  slice.columns = integer_or<0x0028, 0x0011>(data, 0);
  slice.samples_per_pixel = integer_or<0x0028, 0x0002>(data, 1);
  copy_text(text_of(data, gdcm::Tag(0x0028, 0x0004)), slice.photometric_text);
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

/// What a file says; may end the process if it is damaged.
std::optional<DicomSlice> parse(const fs::path& path, bool certainly_dicom) {
  std::ifstream file(path, std::ios::binary);
  gdcm::Reader reader;
  reader.SetStream(file);  // a stream of ours, whose position can be asked for afterwards
  if (!certainly_dicom && !reader.CanRead()) return std::nullopt;
  // Skipping that element leaves the stream at its value.
  if (!reader.ReadUpToTag(kPixelData, {kPixelData})) {
    if (!certainly_dicom) return std::nullopt;
    throw std::runtime_error("unreadable");
  }
  const gdcm::DataSet& data = reader.GetFile().GetDataSet();
  const bool image = data.FindDataElement(gdcm::Tag(0x0028, 0x0010)) &&
                     data.FindDataElement(gdcm::Tag(0x0020, 0x000e));
  if (!image) return std::nullopt;
  DicomSlice slice = describe(data);
  const gdcm::TransferSyntax& syntax = reader.GetFile().GetHeader().GetDataSetTransferSyntax();
  slice.extent.offset = static_cast<std::uint64_t>(std::streamoff{file.tellg()});
  slice.extent.encapsulated = syntax.IsEncapsulated();
  slice.extent.deflated =
      syntax == gdcm::TransferSyntax(gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian);
  return slice;
}

/// Fills `samples`, or throws, or ends the process.
void decode_samples(const fs::path& path, std::span<std::byte> samples) {
  gdcm::ImageReader reader;
  reader.SetFileName(path.c_str());
  if (!reader.Read()) throw std::runtime_error("unreadable");
  const gdcm::Image& image = reader.GetImage();
  if (image.GetBufferLength() != samples.size() ||
      !image.GetBuffer(reinterpret_cast<char*>(samples.data()))) {
    throw std::runtime_error("other samples than announced");
  }
}

}  // namespace
}  // namespace nacre

extern "C" {

bool nacre_gdcm_describe(const char* path, bool certainly_dicom, nacre::DicomSlice* slice) {
  gdcm::Trace::WarningOff();
  const std::optional<nacre::DicomSlice> found = nacre::parse(path, certainly_dicom);
  if (found) *slice = *found;
  return found.has_value();
}

void nacre_gdcm_decode(const char* path, std::byte* samples, std::size_t size) {
  gdcm::Trace::WarningOff();
  nacre::decode_samples(path, {samples, size});
}

}  // extern "C"
