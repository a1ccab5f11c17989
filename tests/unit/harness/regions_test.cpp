// Regions of a homogeneous sphere are known in closed form: at distance b from its centre a ray is absorbed by
// 1 - exp(-2 tau sqrt(R^2 - b^2)) and meets the surface at an angle of cosine sqrt(1 - b^2 / R^2).
#include "harness/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/gates.h"
#include "harness/metrics/metrics.h"
#include "scenes/scene_io.h"

namespace volumark {
namespace {

constexpr double kRadius = 0.8;
constexpr int kEdge = 96;

struct Sphere {
  Scene scene;
  View view;

  explicit Sphere(double extinction) {
    scene = load_scene("sphere");
    load_data(scene, {});
    for (size_t i = 0; i < 2; ++i) scene.transfer.points[i].extinction = extinction;
    view = scene.views[0];
    view.perspective = false;
    view.half_height = 1;
  }
  double distance(int x, int y) const {
    const Ray ray = pixel_ray(view, kEdge, kEdge, x, y);
    return glm::length(glm::cross(ray.origin, ray.direction));
  }
  double alpha(int x, int y) const {
    const double b = distance(x, y);
    return b < kRadius ? -std::expm1(-2 * scene.transfer.points[0].extinction * std::sqrt(kRadius * kRadius - b * b))
                       : 0;
  }
  Reference reference() const { return render_reference(scene, view, kEdge, kEdge); }
};

Region at(const RegionMap& map, int x, int y) { return map.pixels[static_cast<size_t>(y * map.width + x)]; }

TEST(Regions, BackgroundAndSilhouetteOfASphere) {
  const Sphere sphere(1.25);
  const RegionMap map = region_map(sphere.scene, sphere.view, sphere.reference());
  EXPECT_FALSE(map.shows_nothing);
  int seen[4] = {};
  for (int y = 1; y + 1 < kEdge; ++y) {
    for (int x = 1; x + 1 < kEdge; ++x) {
      double lo = 1, hi = 0, nearest = 1;  // nearest: to the sphere's edge
      for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) {
          lo = std::min(lo, sphere.alpha(u, v));
          hi = std::max(hi, sphere.alpha(u, v));
          nearest = std::min(nearest, std::abs(sphere.distance(u, v) - kRadius));
        }
      // Closer to the edge than the field's own error, or to the threshold: rounding decides.
      if (nearest < 2e-4 || std::abs(hi - lo - kSilhouetteSpan) < 2e-3) continue;
      const Region region = at(map, x, y);
      ++seen[static_cast<size_t>(region)];
      if (hi == 0)
        EXPECT_EQ(region, Region::Background) << x << ' ' << y;
      else if (hi - lo > kSilhouetteSpan)
        EXPECT_EQ(region, Region::Silhouette) << x << ' ' << y;
      else
        EXPECT_TRUE(region == Region::Interior || region == Region::Grazing) << x << ' ' << y;
    }
  }
  EXPECT_GT(seen[static_cast<size_t>(Region::Background)], 1000);
  EXPECT_GT(seen[static_cast<size_t>(Region::Silhouette)], 100);
  EXPECT_GT(seen[static_cast<size_t>(Region::Interior)], 1000);
}

// Thin matter has no silhouette: what is seen of its edge is grazing, where b / R > sqrt(1 - .04).
TEST(Regions, GrazingRingOfAThinSphere) {
  Sphere sphere(0.05);
  const ViewFrame frame = frame_of(sphere.view);
  sphere.view.eye += kRadius * frame.right;
  sphere.view.target += kRadius * frame.right;
  sphere.view.half_height = 0.1;
  const RegionMap map = region_map(sphere.scene, sphere.view, sphere.reference());
  int grazing = 0, interior = 0;
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) {
      const double b = sphere.distance(x, y);
      EXPECT_NE(at(map, x, y), Region::Silhouette);
      if (b > kRadius - 1e-3) continue;  // the field's own error
      const double cosine = std::sqrt(1 - b * b / (kRadius * kRadius));
      // The first sample lies up to half a voxel behind the surface: 0.01 in the cosine.
      if (std::abs(cosine - kGrazingCosine) < 0.02) continue;
      EXPECT_EQ(at(map, x, y), cosine < kGrazingCosine ? Region::Grazing : Region::Interior)
          << x << ' ' << y << " cosine " << cosine;
      ++(cosine < kGrazingCosine ? grazing : interior);
    }
  }
  EXPECT_GT(grazing, 200);
  EXPECT_GT(interior, 1000);
}

TEST(Regions, DoNotDependOnThreads) {
  const Sphere sphere(1.25);
  const Reference reference = sphere.reference();
  EXPECT_EQ(region_map(sphere.scene, sphere.view, reference, 1).pixels,
            region_map(sphere.scene, sphere.view, reference, 2).pixels);
}

TEST(Regions, AClipPlaneMovesWhereTheRayEnters) {
  // Half of the sphere is cut away along the view: every ray enters at the plane through the centre, where the data's
  // gradient points outwards in the plane, and so along none of the rays.
  Sphere sphere(1.25);
  const ViewFrame frame = frame_of(sphere.view);
  sphere.scene.effects.clip_planes = {{frame.forward, 0}};
  const RegionMap map = region_map(sphere.scene, sphere.view, sphere.reference());
  int grazing = 0, interior = 0;
  for (int y = 0; y < kEdge; ++y)
    for (int x = 0; x < kEdge; ++x) {
      const double b = sphere.distance(x, y);
      if (b < 0.1 || b > 0.7) continue;
      grazing += at(map, x, y) == Region::Grazing;
      interior += at(map, x, y) == Region::Interior;
    }
  EXPECT_GT(grazing, 1000);
  EXPECT_EQ(interior, 0);
}

TEST(RegionErrors, EachPixelCountsInItsRegionAlone) {
  RegionMap map;
  map.width = 3;
  map.height = 1;
  map.pixels = {Region::Background, Region::Interior, Region::Interior};
  Image reference(3, 1), test(3, 1);
  for (int x = 0; x < 3; ++x) reference.pixel(x, 0)[3] = test.pixel(x, 0)[3] = 1;
  test.pixel(0, 0)[0] = 0.5F;
  test.pixel(2, 0)[1] = -0.25F;
  const auto errors = region_errors(test, reference, map, glm::dvec3(0));
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_EQ(errors.at("background").pixels, 1);
  EXPECT_DOUBLE_EQ(errors.at("background").max, 0.5);
  EXPECT_DOUBLE_EQ(errors.at("background").rmse, std::sqrt(0.25 / 3));
  EXPECT_EQ(errors.at("interior").pixels, 2);
  EXPECT_DOUBLE_EQ(errors.at("interior").max, 0.25);
  EXPECT_DOUBLE_EQ(errors.at("interior").mae, 0.25 / 6);
  map.pixels.pop_back();
  EXPECT_THROW(region_errors(test, reference, map, glm::dvec3(0)), MetricError);
}

TEST(RegionErrors, OverViewsTakesTheWorstAndTheMeanOfThoseThatHaveIt) {
  ErrorMetrics one, two, three;
  one.regions["interior"] = {10, 0.1, 0.5, 0.05};
  two.regions["interior"] = {30, 0.3, 0.4, 0.01};
  two.regions["grazing"] = {2, 0.6, 0.7, 0.5};
  const CellError error = over_views({one, two, three});
  EXPECT_EQ(error.worst.regions.at("interior").pixels, 40);
  EXPECT_DOUBLE_EQ(error.worst.regions.at("interior").rmse, 0.3);
  EXPECT_DOUBLE_EQ(error.worst.regions.at("interior").max, 0.5);
  EXPECT_DOUBLE_EQ(error.mean.regions.at("interior").rmse, 0.2);
  EXPECT_DOUBLE_EQ(error.worst.regions.at("grazing").rmse, 0.6);
  EXPECT_DOUBLE_EQ(error.mean.regions.at("grazing").rmse, 0.6);
}

}  // namespace
}  // namespace volumark
