#include "shells/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shells/triangle_distance.h"

namespace nacre {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr std::size_t kDepth = 64;  // of a tree that halves at most 2^32 triangles, with room

TriangleCorners corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const glm::uvec3& t = mesh.triangles[triangle];
  return {glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
          glm::dvec3(mesh.positions[t.z])};
}

int longest_axis(const glm::vec3& size) {
  const int wider = size.y > size.x ? 1 : 0;
  return size.z > size[wider] ? 2 : wider;
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  std::vector<glm::vec3> centers;
  centers.reserve(order_.size());
  for (const glm::uvec3& t : mesh.triangles) {
    centers.push_back((mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0F);
  }
  if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()), centers);
}

void TriangleTree::enclose(Node& node) const {
  node.lo = glm::vec3(std::numeric_limits<float>::max());
  node.hi = glm::vec3(std::numeric_limits<float>::lowest());
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3& p = mesh_.positions[mesh_.triangles[order_[i]][corner]];
      node.lo = glm::min(node.lo, p);
      node.hi = glm::max(node.hi, p);
    }
  }
}

std::uint32_t TriangleTree::build(std::uint32_t begin, std::uint32_t end,
                                  std::vector<glm::vec3>& centers) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node{{}, {}, begin, end, 0};
  enclose(node);
  nodes_.push_back(node);
  if (end - begin <= kLeafTriangles) return index;
  const int axis = longest_axis(node.hi - node.lo);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
      [&](std::uint32_t a, std::uint32_t b) {
        return centers[a][axis] != centers[b][axis] ? centers[a][axis] < centers[b][axis] : a < b;
      });
  build(begin, middle, centers);
  nodes_[index].right = build(middle, end, centers);
  return index;
}

double TriangleTree::squared_distance(const Node& node, const glm::dvec3& p) const {
  const glm::dvec3 below = glm::dvec3(node.lo) - p;
  const glm::dvec3 above = p - glm::dvec3(node.hi);
  const glm::dvec3 out = glm::max(glm::max(below, above), glm::dvec3(0.0));
  return glm::dot(out, out);
}

template <class Limit, class Visit>
void TriangleTree::near(const glm::dvec3& p, Limit&& squared_limit, Visit&& visit) const {
  if (nodes_.empty()) return;
  struct Waiting {
    std::uint32_t node;
    double squared;
  };
  std::array<Waiting, kDepth> stack;
  std::size_t size = 0;
  stack[size++] = {0, squared_distance(nodes_[0], p)};
  while (size > 0) {
    const Waiting next = stack[--size];
    if (next.squared >= squared_limit()) continue;
    const Node& node = nodes_[next.node];
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) visit(order_[i]);
      continue;
    }
    Waiting first{next.node + 1, squared_distance(nodes_[next.node + 1], p)};
    Waiting second{node.right, squared_distance(nodes_[node.right], p)};
    if (second.squared < first.squared) std::swap(first, second);
    stack[size++] = second;  // the nearer one is taken first
    stack[size++] = first;
  }
}

double TriangleTree::distance(const glm::dvec3& p, double within) const {
  double best = within * within;
  near(
      p, [&] { return best; },
      [&](std::uint32_t triangle) {
        const auto [a, b, c] = corners_of(mesh_, triangle);
        best = std::min(best, squared_distance_to_triangle(p, a, b, c));
      });
  return std::min(std::sqrt(best), within);
}

double TriangleTree::cover_radius(const TriangleCorners& corners, double within,
                                  double enough) const {
  double best = within * within;
  const double stop = enough * enough;
  // A triangle near all corners is near the centroid, too: no farther than from the corners.
  const glm::dvec3 center = (corners[0] + corners[1] + corners[2]) / 3.0;
  near(
      center, [&] { return best <= stop ? 0.0 : best; },
      [&](std::uint32_t triangle) {
        const auto [a, b, c] = corners_of(mesh_, triangle);
        double farthest = 0.0;
        for (const glm::dvec3& corner : corners) {
          farthest = std::max(farthest, squared_distance_to_triangle(corner, a, b, c));
        }
        best = std::min(best, farthest);
      });
  return std::min(std::sqrt(best), within);
}

}  // namespace nacre
