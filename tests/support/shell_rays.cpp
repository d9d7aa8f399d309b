#include "tests/support/shell_rays.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace nacre::testing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Crossing {
  double t_mm;
  bool entering;
  glm::dvec3 normal;  ///< of the triangle, unit length
};

/// A ray through a shared edge must not slip between its triangles.
constexpr double kEdge = 1e-12;

/// Moller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection", both sides.
void add_crossing(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                  std::vector<Crossing>& crossings) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const glm::dvec3 p = glm::cross(ray.direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return;
  const glm::dvec3 from_a = ray.origin_mm - a;
  const double u = glm::dot(from_a, p) / determinant;
  const glm::dvec3 q = glm::cross(from_a, ab);
  const double v = glm::dot(ray.direction, q) / determinant;
  if (u < -kEdge || v < -kEdge || u + v > 1.0 + kEdge) return;
  crossings.push_back(
      {glm::dot(ac, q) / determinant, determinant > 0.0, glm::normalize(glm::cross(ab, ac))});
}

/// All crossings of the line with the mesh, by t; the positions are first mapped.
std::vector<Crossing> crossings_of(const Ray& ray, const TriangleMesh& mesh,
                                   const std::function<glm::dvec3(const glm::vec3&)>& place) {
  std::vector<Crossing> crossings;
  for (const glm::uvec3& t : mesh.triangles) {
    add_crossing(ray, place(mesh.positions[t.x]), place(mesh.positions[t.y]),
                 place(mesh.positions[t.z]), crossings);
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.t_mm < b.t_mm; });
  return crossings;
}

std::vector<Crossing> crossings_of(const Ray& ray, const TriangleMesh& mesh) {
  return crossings_of(ray, mesh, [](const glm::vec3& p) { return glm::dvec3(p); });
}

/// The parts of the line inside a closed mesh, clipped to the interval. (Entering an edge counts
/// once for each of its triangles, and so does leaving.)
std::vector<std::pair<double, double>> parts_inside(const std::vector<Crossing>& crossings,
                                                    const RayInterval& interval) {
  std::vector<std::pair<double, double>> parts;
  int around = 0;
  double entered = 0.0;
  for (const Crossing& crossing : crossings) {
    const int before = around;
    around += crossing.entering ? 1 : -1;
    if (before == 0 && around > 0) entered = crossing.t_mm;
    if (before <= 0 || around > 0) continue;
    const double begin = std::max(entered, interval.t_begin_mm);
    const double end = std::min(crossing.t_mm, interval.t_end_mm);
    if (begin < end) parts.emplace_back(begin, end);
  }
  return parts;
}

Ray relative_to(const glm::dvec3& center_mm, const Ray& ray) {
  return {ray.origin_mm - center_mm, ray.direction};
}

}  // namespace

ShellRays::ShellRays(const ShellSet& set, std::span<const Tool> tools, const Camera& camera,
                     const DepthCue& cue, const Slab& slab)
    : set_(set), tools_(tools), camera_(camera), cue_(cue), slab_(slab) {}

double ShellRays::cue_at(const Ray& ray, double t_mm) const {
  return beta(cue_, depth_z(camera_, ray.origin_mm + t_mm * ray.direction));
}

RayInterval ShellRays::interval(const Ray& ray) const {
  return visible_interval(camera_, ray, slab_);
}

double ShellRays::tool_t_mm(double pixel_x, double pixel_y) const {
  const Ray ray = picture_ray(camera_, pixel_x, pixel_y);
  double nearest = kInfinity;
  for (const Tool& tool : tools_) {
    const auto place = [&](const glm::vec3& p) {
      return glm::dvec3(tool.world_from_tool * glm::dvec4(p, 1.0));
    };
    for (const Crossing& crossing : crossings_of(ray, tool.mesh, place)) {
      if (camera_.perspective && crossing.t_mm <= 0.0) continue;
      nearest = std::min(nearest, crossing.t_mm);
    }
  }
  return nearest;
}

std::optional<glm::vec3> ShellRays::tool_color(double pixel_x, double pixel_y) const {
  const Ray ray = picture_ray(camera_, pixel_x, pixel_y);
  double nearest = kInfinity;
  std::optional<glm::vec3> color;
  for (const Tool& tool : tools_) {
    const auto place = [&](const glm::vec3& p) {
      return glm::dvec3(tool.world_from_tool * glm::dvec4(p, 1.0));
    };
    for (const Crossing& crossing : crossings_of(ray, tool.mesh, place)) {
      if (crossing.t_mm >= nearest || (camera_.perspective && crossing.t_mm <= 0.0)) continue;
      nearest = crossing.t_mm;
      const double z =
          std::clamp(depth_z(camera_, ray.origin_mm + nearest * ray.direction), 0.0, 1.0);
      const double cosine = std::abs(glm::dot(crossing.normal, ray.direction));
      color = tool.color * static_cast<float>(headlight(cosine) * beta(cue_, z));
    }
  }
  return color;
}

double ShellRays::maximum(double pixel_x, double pixel_y) const {
  const Ray ray = picture_ray(camera_, pixel_x, pixel_y);
  RayInterval shown = interval(ray);
  shown.t_end_mm = std::min(shown.t_end_mm, tool_t_mm(pixel_x, pixel_y));
  double largest = 0.0;
  for (const Shell& shell : set_.shells) {
    const auto crossings = crossings_of(relative_to(set_.center_mm, ray), shell.surface);
    for (const auto& [begin, end] : parts_inside(crossings, shown)) {
      largest =
          std::max(largest, shell.representative * std::max(cue_at(ray, begin), cue_at(ray, end)));
    }
  }
  return largest;
}

double ShellRays::sum(double pixel_x, double pixel_y) const {
  const Ray ray = picture_ray(camera_, pixel_x, pixel_y);
  RayInterval shown = interval(ray);
  shown.t_end_mm = std::min(shown.t_end_mm, tool_t_mm(pixel_x, pixel_y));
  double total = 0.0;
  double around = 0.0;
  for (const Shell& shell : set_.shells) {
    const auto crossings = crossings_of(relative_to(set_.center_mm, ray), shell.surface);
    for (const auto& [begin, end] : parts_inside(crossings, shown)) {
      const double mean = 0.5 * (cue_at(ray, begin) + cue_at(ray, end));  // beta is linear
      total += (shell.representative - around) * (end - begin) * mean;
    }
    around = shell.representative;
  }
  return total;
}

double ShellRays::count(double pixel_x, double pixel_y) const {
  const Ray ray = picture_ray(camera_, pixel_x, pixel_y);
  RayInterval shown = interval(ray);
  shown.t_end_mm = std::min(shown.t_end_mm, tool_t_mm(pixel_x, pixel_y));
  double total = 0.0;
  for (const Shell& shell : set_.shells) {
    for (const Crossing& crossing : crossings_of(relative_to(set_.center_mm, ray), shell.surface)) {
      const bool shows = crossing.t_mm >= shown.t_begin_mm && crossing.t_mm <= shown.t_end_mm;
      if (shows) total += shell.representative;
    }
  }
  return total;
}

double ShellRays::lit_ball(double pixel_x, double pixel_y) const {
  const Ray ray = picture_ray(camera_, pixel_x, pixel_y);
  RayInterval shown = interval(ray);
  shown.t_end_mm = std::min(shown.t_end_mm, tool_t_mm(pixel_x, pixel_y));
  double nearest = kInfinity;
  for (const Shell& shell : set_.shells) {
    for (const Crossing& crossing : crossings_of(relative_to(set_.center_mm, ray), shell.surface)) {
      const bool shows = crossing.t_mm >= shown.t_begin_mm && crossing.t_mm <= shown.t_end_mm;
      if (shows) nearest = std::min(nearest, crossing.t_mm);
    }
  }
  if (nearest == kInfinity) return 0.0;
  const glm::dvec3 p = ray.origin_mm + nearest * ray.direction;
  const double cosine = -glm::dot(glm::normalize(p - set_.center_mm), ray.direction);
  return headlight(cosine) * cue_at(ray, nearest);
}

}  // namespace nacre::testing
