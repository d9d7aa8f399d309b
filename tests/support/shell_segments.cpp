#include "tests/support/shell_segments.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace nacre::testing {
namespace {

std::optional<double> meeting(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b,
                              const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const glm::dvec3 p = glm::cross(ray.direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return std::nullopt;
  const glm::dvec3 from_a = ray.origin_mm - a;
  const double u = glm::dot(from_a, p) / determinant;
  const glm::dvec3 q = glm::cross(from_a, ab);
  const double v = glm::dot(ray.direction, q) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0) return std::nullopt;
  return glm::dot(ac, q) / determinant;
}

/// Sorted t of all crossings of a mesh.
std::vector<double> crossings(const TriangleMesh& mesh, const Ray& ray) {
  std::vector<double> found;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto met = meeting(ray, glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
                             glm::dvec3(mesh.positions[t.z]));
    if (met) found.push_back(*met);
  }
  std::ranges::sort(found);
  return found;
}

double cue_at(const Camera& camera, const DepthCue& cue, const Ray& ray, double t) {
  return beta(cue, depth_z(camera, ray.origin_mm + t * ray.direction));
}

}  // namespace

std::vector<ShellSegment> shell_segments(const ShellSet& set, const Ray& ray) {
  const Ray local{ray.origin_mm - set.center_mm, ray.direction};
  std::vector<std::vector<double>> of_shell;
  std::vector<double> ends;
  for (const Shell& shell : set.shells) {
    of_shell.push_back(crossings(shell.surface, local));
    ends.insert(ends.end(), of_shell.back().begin(), of_shell.back().end());
  }
  std::ranges::sort(ends);
  std::vector<ShellSegment> segments;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    ShellSegment segment{ends[i], ends[i + 1], 0};
    const double middle = 0.5 * (ends[i] + ends[i + 1]);
    for (const auto& of : of_shell) {  // an odd number of crossings before it: inside
      const auto before = std::ranges::lower_bound(of, middle) - of.begin();
      segment.shells += before % 2 == 1 ? 1 : 0;
    }
    if (segment.shells > 0) segments.push_back(segment);
  }
  return segments;
}

double first_tool_mm(const Tool& tool, const Ray& ray, double from_mm) {
  TriangleMesh posed = tool.mesh;
  for (glm::vec3& p : posed.positions) {
    p = glm::vec3(tool.world_from_tool * glm::dvec4(glm::dvec3(p), 1.0));
  }
  for (const double t : crossings(posed, ray)) {
    if (t >= from_mm) return t;
  }
  return std::numeric_limits<double>::infinity();
}

std::vector<ShellSegment> clip(std::vector<ShellSegment> segments, const RayInterval& interval) {
  for (ShellSegment& segment : segments) {
    segment.t_begin = std::max(segment.t_begin, interval.t_begin_mm);
    segment.t_end = std::min(segment.t_end, interval.t_end_mm);
  }
  std::erase_if(segments, [](const ShellSegment& s) { return !(s.t_begin < s.t_end); });
  return segments;
}

double segment_maximum(const ShellSet& set, const std::vector<ShellSegment>& segments,
                       const Camera& camera, const DepthCue& cue, const Ray& ray) {
  double largest = 0.0;
  for (const ShellSegment& segment : segments) {
    for (const double t : {segment.t_begin, segment.t_end}) {
      largest = std::max(
          largest, set.shells[segment.shells - 1].representative * cue_at(camera, cue, ray, t));
    }
  }
  return largest;
}

double segment_integral(const ShellSet& set, const std::vector<ShellSegment>& segments,
                        const Camera& camera, const DepthCue& cue, const Ray& ray) {
  long double sum = 0.0L;
  for (const ShellSegment& segment : segments) {
    // The mean of a linear function is that of its ends.
    const long double mean = (static_cast<long double>(cue_at(camera, cue, ray, segment.t_begin)) +
                              cue_at(camera, cue, ray, segment.t_end)) /
                             2.0L;
    sum += set.shells[segment.shells - 1].representative * mean *
           (static_cast<long double>(segment.t_end) - segment.t_begin);
  }
  return static_cast<double>(sum);
}

}  // namespace nacre::testing
