#include "report/report_tables.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace nacre {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(const Spread& spread) {
  if (spread.samples == 0) return nullptr;  // unknown
  return {{"median", spread.median},
          {"quartiles", {spread.lower, spread.upper}},
          {"samples", spread.samples}};
}

/// JSON knows no infinity: no error is a PSNR of null.
ordered_json to_json(const PictureError& error) {
  ordered_json json;
  json["pixels"] = error.pixels;
  json["rmse"] = error.rmse;
  json["psnr_db"] = std::isfinite(error.psnr_db) ? ordered_json(error.psnr_db) : ordered_json();
  json["max_error"] = error.max_error;
  json["bias"] = error.bias;
  return json;
}

ordered_json to_json(const std::optional<std::size_t>& bytes) {
  return bytes ? ordered_json(*bytes) : ordered_json();
}

ordered_json method_json(const Method& method) {
  ordered_json json = {{"id", method.id}, {"part", method.part}, {"backend", method.backend}};
  if (method.peer) {
    json["caster"] = method.peer->caster;
    json["step"] = method.peer->step;
  }
  if (method.samples) json["samples"] = *method.samples;
  if (!method.shells) return json;
  json["levels"] = text_of(method.shells->levels);
  json["tolerance"] = method.shells->tolerance;
  if (method.shells->quantization_bits > 0) {
    json["quantization_bits"] = method.shells->quantization_bits;
  }
  json["depth_buffer"] = name(method.depth);
  json["target"] = name(method.target);
  json["occlusion"] = name(method.occlusion);
  return json;
}

ordered_json row_json(const Measured& row, const ReportContext& context) {
  ordered_json json = method_json(row.method);
  if (!row.left_out.empty()) {
    json["left_out"] = row.left_out;
    return json;
  }
  json["device"] = row.device;
  json["triangles"] = row.triangles;
  json["bytes"] = row.bytes;
  json["seconds"] = {{"build", to_json(row.build_seconds)},
                     {"load", to_json(row.load_seconds)},
                     {"frame", to_json(row.frame_seconds)}};
  json["peak_bytes"] = {{"build", to_json(row.build_peak_bytes)},
                        {"draw", to_json(row.draw_peak_bytes)}};
  json["error"] = {
      {"peak", row.error.peak}, {"lit", to_json(row.error.lit)}, {"all", to_json(row.error.all)}};
  json["commands"] = command_lines(row.method, context.commands);
  return json;
}

ordered_json machine_json(const MachineFacts& machine) {
  return {{"processor", machine.processor},
          {"threads", machine.threads},
          {"memory_bytes", machine.memory_bytes},
          {"system", machine.system},
          {"compiler", machine.compiler},
          {"checked_build", machine.checked_build},
          {"load", machine.load},
          {"date", machine.date}};
}

/// A field of CSV: quoted where commas, quotes or line ends are in it.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted;
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return fmt::format("\"{}\"", quoted);
}

std::string bytes_field(const std::optional<std::size_t>& bytes) {
  return bytes ? fmt::format("{}", *bytes) : "";
}

std::vector<std::string> figure_fields(const Measured& row) {
  std::vector<std::string> fields{fmt::format("{}", row.triangles), fmt::format("{}", row.bytes)};
  for (const Spread* spread : {&row.build_seconds, &row.load_seconds, &row.frame_seconds}) {
    for (const double value : {spread->median, spread->lower, spread->upper}) {
      fields.push_back(spread->samples > 0 ? fmt::format("{:.6g}", value) : "");
    }
  }
  fields.push_back(bytes_field(row.build_peak_bytes));
  fields.push_back(bytes_field(row.draw_peak_bytes));
  for (const PictureError* error : {&row.error.lit, &row.error.all}) {
    fields.push_back(std::isfinite(error->psnr_db) ? fmt::format("{:.6g}", error->psnr_db) : "inf");
    fields.push_back(fmt::format("{:.9g}", error->rmse));
    fields.push_back(fmt::format("{:.9g}", error->max_error));
  }
  fields.push_back(field(row.device));
  return fields;
}

constexpr std::string_view kCsvNames =
    "id,part,backend,levels,tolerance,quantization_bits,depth_buffer,target,occlusion,step,"
    "samples,left_out,"
    "triangles,bytes,build_s,build_s_q1,build_s_q3,load_s,load_s_q1,load_s_q3,frame_s,frame_s_q1,"
    "frame_s_q3,build_peak_bytes,draw_peak_bytes,psnr_lit_db,rmse_lit,max_error_lit,psnr_all_db,"
    "rmse_all,max_error_all,device";

std::string csv_line(const Measured& row) {
  const Method& method = row.method;
  std::string line =
      fmt::format("{},{},{},", field(method.id), field(method.part), field(method.backend));
  if (method.shells) {
    const int bits = method.shells->quantization_bits;
    line += fmt::format("{},{},{},{},{},{}", text_of(method.shells->levels),
                        method.shells->tolerance, bits > 0 ? fmt::format("{}", bits) : "",
                        name(method.depth), name(method.target), name(method.occlusion));
  } else {
    line += ",,,,,";
  }
  line += method.peer ? fmt::format(",{}", method.peer->step) : ",";
  line += method.samples ? fmt::format(",{}", *method.samples) : ",";
  line += fmt::format(",{}", field(row.left_out));
  if (row.left_out.empty()) {
    for (const std::string& figure : figure_fields(row)) line += fmt::format(",{}", figure);
  } else {
    constexpr int kFigures = 20;
    line += std::string(kFigures, ',');
  }
  return line + "\r\n";
}

}  // namespace

std::string report_json(const MeasurementResult& result, const ReportContext& context) {
  ordered_json json;
  json["version"] = context.version;
  json["volume"] = {
      {"name", context.volume}, {"samples", context.samples}, {"window", context.window}};
  json["views"] = context.views;
  json["passes"] = result.passes;
  json["seconds"] = result.seconds;
  json["command"] = context.repeats_it;
  json["machine"] = machine_json(context.machine);
  json["rows"] = ordered_json::array();
  for (const Measured& row : result.rows) json["rows"].push_back(row_json(row, context));
  return json.dump(2) + "\n";
}

std::string report_csv(const MeasurementResult& result) {
  std::string csv(kCsvNames);
  csv += "\r\n";
  for (const Measured& row : result.rows) csv += csv_line(row);
  return csv;
}

}  // namespace nacre
