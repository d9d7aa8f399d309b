#include "tests/render/cpu_test_support.h"

#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "datasets/phantom.h"
#include "extract/levels.h"
#include "extract/marching_cubes.h"
#include "tests/support/nested_shells.h"

namespace nacre::testing {

Scan small_angiogram() {
  const Volume volume = make_phantom("angiogram", {.size = glm::i64vec3(48, 48, 32)});
  Scan scan{{}, bounding_sphere(volume.dims, volume.world_from_voxel)};
  std::vector<double> values;
  for (const Level& level : uniform_levels(8)) {
    values.push_back(250.0 + 1000.0 * level.emission);
    scan.set.shells.push_back({level.emission, values.back(), level.representative, {}});
  }
  std::vector<TriangleMesh> surfaces = extract_surfaces(volume, values);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    scan.set.shells[i].surface = std::move(surfaces[i]);
  }
  scan.set.center_mm = scan.sphere.center_mm;
  return scan;
}

Picture draw(const ShellSet& set, std::span<const Tool> tools, const Camera& camera,
             const RenderOptions& options, const CpuOptions& how) {
  CpuRenderer renderer(how);
  renderer.upload(set);
  renderer.upload_tools(tools);
  return renderer.render(camera, options);
}

std::vector<Camera> cameras(const BoundingSphere& sphere, const glm::ivec2& size) {
  const double radius = sphere.radius_mm;
  const CameraOptions turned{.size = size, .azimuth_rad = 0.6, .elevation_rad = 0.35};
  std::vector<Camera> list{make_camera(turned, sphere)};
  CameraOptions options = turned;
  options.zoom = 6.0;
  list.push_back(make_camera(options, sphere));
  options = turned;
  options.field_of_view_rad = 0.7;
  list.push_back(make_camera(options, sphere));
  options.distance_mm = 0.3 * radius;
  options.field_of_view_rad = 1.5;
  list.push_back(make_camera(options, sphere));
  return list;
}

Tool tool_of(TriangleMesh mesh, const glm::dvec3& at, const glm::vec3& color) {
  return {"tool", std::move(mesh), glm::translate(glm::dmat4(1.0), at), color};
}

std::vector<std::vector<Tool>> tools_about(const BoundingSphere& sphere, const Camera& camera) {
  const double radius = sphere.radius_mm;
  const auto ball = [&](double along) {
    return tool_of(ball_mesh({}, 0.25 * radius, 12),
                   sphere.center_mm + camera.forward * (along * radius), {0.3F, 0.7F, 1.0F});
  };
  const double thin = 0.03 * radius;
  const Tool rod = tool_of(block_mesh({-radius, -thin, -thin}, {0.6 * radius, thin, thin}),
                           sphere.center_mm, {1.0F, 0.5F, 0.2F});
  return {{ball(-1.2)}, {ball(0.0)}, {ball(1.2)}, {ball(0.2), rod}};
}

std::vector<Slab> slabs(double radius_mm) {
  return {{.near_mm = -0.15 * radius_mm},
          {.far_mm = 0.2 * radius_mm},
          {.near_mm = -0.1 * radius_mm, .far_mm = 0.15 * radius_mm}};
}

}  // namespace nacre::testing
