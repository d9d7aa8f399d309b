#include "tests/support/dicom_files.h"

#include <fmt/core.h>
#include <gdcmAttribute.h>
#include <gdcmImage.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageWriter.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>
#include <gdcmUIDGenerator.h>

#include <stdexcept>

namespace nacre::testing {
namespace {

void put_text(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, gdcm::VR vr,
              std::string text) {
  if (text.size() % 2 == 1) text += vr == gdcm::VR::UI ? '\0' : ' ';
  gdcm::DataElement value(gdcm::Tag(group, element));
  value.SetVR(vr);
  value.SetByteValue(text.data(), gdcm::VL(static_cast<std::uint32_t>(text.size())));
  data.Replace(value);
}

std::string vector_text(const glm::dvec3& v) {
  return fmt::format("{:.9g}\\{:.9g}\\{:.9g}", v.x, v.y, v.z);
}

gdcm::PixelFormat pixel_format(const DicomSliceSpec& spec) {
  gdcm::PixelFormat format(spec.is_signed ? gdcm::PixelFormat::INT16 : gdcm::PixelFormat::UINT16);
  format.SetBitsStored(static_cast<unsigned short>(spec.bits_stored));
  format.SetHighBit(static_cast<unsigned short>(spec.bits_stored - 1));
  if (spec.photometric == "RGB") {
    format = gdcm::PixelFormat(gdcm::PixelFormat::UINT8);
    format.SetSamplesPerPixel(3);
  }
  return format;
}

void fill_image(const DicomSliceSpec& spec, gdcm::Image& image) {
  image.SetNumberOfDimensions(spec.frames > 1 ? 3 : 2);  // before the sizes
  image.SetDimension(0, spec.columns);
  image.SetDimension(1, spec.rows);
  if (spec.frames > 1) image.SetDimension(2, spec.frames);
  image.SetPixelFormat(pixel_format(spec));
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation(
      gdcm::PhotometricInterpretation::GetPIType(spec.photometric.c_str())));
  image.SetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  std::vector<std::int16_t> samples = spec.samples;
  samples.resize(std::size_t{spec.columns} * spec.rows * spec.frames, spec.fill);
  std::size_t size = samples.size() * sizeof(std::int16_t);
  if (spec.photometric == "RGB") {
    size = std::size_t{3} * spec.columns * spec.rows;
    samples.resize((size + 1) / 2);
  }
  gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
  pixels.SetByteValue(reinterpret_cast<const char*>(samples.data()),
                      gdcm::VL(static_cast<std::uint32_t>(size)));
  image.SetDataElement(pixels);
}

void fill_header(const DicomSliceSpec& spec, gdcm::DataSet& data) {
  gdcm::UIDGenerator uids;
  put_text(data, 0x0008, 0x0016, gdcm::VR::UI,
           spec.frames > 1 ? "1.2.840.10008.5.1.4.1.1.7.3" : "1.2.840.10008.5.1.4.1.1.7");
  put_text(data, 0x0008, 0x0018, gdcm::VR::UI, uids.Generate());
  put_text(data, 0x0020, 0x000e, gdcm::VR::UI, spec.series_uid);
  put_text(data, 0x0018, 0x0050, gdcm::VR::DS, "99");  // thickness
  put_text(data, 0x0018, 0x0088, gdcm::VR::DS, "77");  // spacing between slices
}

}  // namespace

void write_dicom(const DicomSliceSpec& spec, const std::filesystem::path& path) {
  gdcm::Trace::WarningOff();
  gdcm::ImageWriter writer;
  fill_image(spec, writer.GetImage());
  gdcm::DataSet& data = writer.GetFile().GetDataSet();
  fill_header(spec, data);
  if (spec.jpeg_lossless) {
    gdcm::ImageChangeTransferSyntax change;
    change.SetTransferSyntax(gdcm::TransferSyntax::JPEGLosslessProcess14_1);
    change.SetInput(writer.GetImage());
    if (!change.Change()) throw std::runtime_error("cannot compress");
    writer.SetImage(change.GetOutput());
  }
  writer.SetFileName(path.c_str());
  if (!writer.Write()) throw std::runtime_error("cannot write " + path.string());

  // The writer drops what the kind of image does not have; put it in afterwards.
  gdcm::Reader reader;
  reader.SetFileName(path.c_str());
  if (!reader.Read()) throw std::runtime_error("cannot read " + path.string());
  gdcm::DataSet& written = reader.GetFile().GetDataSet();
  if (spec.has_position) {
    put_text(written, 0x0020, 0x0032, gdcm::VR::DS, vector_text(spec.position));
    put_text(written, 0x0020, 0x0037, gdcm::VR::DS,
             vector_text(spec.x_direction) + "\\" + vector_text(spec.y_direction));
    put_text(written, 0x0028, 0x0030, gdcm::VR::DS, spec.pixel_spacing);
  }
  if (!spec.slope.empty()) put_text(written, 0x0028, 0x1053, gdcm::VR::DS, spec.slope);
  if (!spec.intercept.empty()) put_text(written, 0x0028, 0x1052, gdcm::VR::DS, spec.intercept);
  gdcm::Writer rewriter;
  rewriter.SetFile(reader.GetFile());
  rewriter.SetFileName(path.c_str());
  if (!rewriter.Write()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace nacre::testing
