#include "methods/reference/shell_tracer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>
#include <stdexcept>

#include "methods/reference/lighting.h"
#include "methods/reference/quadrature.h"
#include "scenes/prism_faults.h"

namespace volumark {
namespace {

constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
constexpr double kOnFace = 1e-9;  // in the coordinates of a prism: nearer than this a point counts as on a face
constexpr int kDeepestHalving = 16;
constexpr int kPiecesExpected = 512;  // among which the tolerance is shared

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

const Shell& shell_of(const Scene& scene) {
  if (!scene.shell) throw std::invalid_argument("reference: the scene's shell is not loaded");
  return *scene.shell;
}

Box box_of(const std::array<glm::dvec3, 6>& corners) {
  Box box{corners[0], corners[0]};
  for (const glm::dvec3& corner : corners) {
    box.lo = glm::min(box.lo, corner);
    box.hi = glm::max(box.hi, corner);
  }
  return box;
}

// (emission, extinction) in 0..1 along a piece: the polynomial of degree 4 through samples at 0, 1/4, 1/2, 3/4, 1.
using Samples = std::array<glm::dvec4, 5>;
struct Fit {
  std::array<glm::dvec4, 5> c;
  glm::dvec4 off;  // of the middle sample from the cubic through the others

  explicit Fit(const Samples& s) {
    c[0] = s[0];
    c[1] = (-25. * s[0] + 48. * s[1] - 36. * s[2] + 16. * s[3] - 3. * s[4]) / 3.;
    c[2] = (70. * s[0] - 208. * s[1] + 228. * s[2] - 112. * s[3] + 22. * s[4]) / 3.;
    c[3] = (-80. * s[0] + 288. * s[1] - 384. * s[2] + 224. * s[3] - 48. * s[4]) / 3.;
    c[4] = (32. * s[0] - 128. * s[1] + 192. * s[2] - 128. * s[3] + 32. * s[4]) / 3.;
    off = s[2] - (4. * (s[1] + s[3]) - (s[0] + s[4])) / 6.;
  }
  glm::dvec3 emission(double u) const { return glm::dvec3((((c[4] * u + c[3]) * u + c[2]) * u + c[1]) * u + c[0]); }
  // Of the extinction, from 0 to u.
  double integral(double u) const {
    return u * (c[0].w + u * (c[1].w / 2 + u * (c[2].w / 3 + u * (c[3].w / 4 + u * c[4].w / 5))));
  }
};

}  // namespace

// One ray on its way, front to back.
class ShellTracer::Walk {
 public:
  Walk(const ShellTracer& tracer, const Ray& ray, double tolerance)
      : tracer_(tracer), ray_(ray), piece_error_(tolerance / kPiecesExpected), negligible_(tolerance / 8) {
    if (const auto& lighting = tracer.scene_.effects.lighting)
      lights_.emplace(*lighting, glm::dmat3(1), ray, tracer.floor_);
  }

  // The prisms are those that hold all of [t0, t1].
  void add(std::span<const size_t> prisms, double t0, double t1) {
    inside_.clear();
    for (const size_t prism : prisms) {
      Inside inside{prism, PrismPoint(0)};
      tracer_.prisms_[prism].map.locate(ray_.origin + 0.5 * (t0 + t1) * ray_.direction, inside.point);
      inside_.push_back(inside);
    }
    for (double t = t0; t < t1 && !saturated();) {
      const double next = std::min(t1, next_texel(t, t1));
      add_piece(t, next, sample(t), sample(next), 0);
      t = next;
    }
  }
  bool saturated() const { return transmittance() * tracer_.max_radiance_ <= negligible_; }
  RayResult result() const {
    RayResult out;
    out.rgb = rgb_;
    out.alpha = -std::expm1(-depth_);
    out.bound = bound_ + kRounding * static_cast<double>(pieces_ + 1) * tracer_.max_radiance_ +
                (saturated() ? transmittance() * tracer_.max_radiance_ : 0);
    out.pieces = pieces_;
    return out;
  }

 private:
  struct Inside {
    size_t prism;
    PrismPoint point;  // last one looked at, from which the next is found
  };

  double transmittance() const { return std::exp(-depth_); }

  void move(Inside& inside, double t) {
    const glm::dvec3 position = ray_.origin + t * ray_.direction;
    const PrismMap& map = tracer_.prisms_[inside.prism].map;
    // Where Newton fails (near an end of thickness 0, where the map is singular) the cubic tells.
    if (!map.refine(position, inside.point)) map.locate(position, inside.point);
  }

  // Lit emission and extinction.
  glm::dvec4 sample(double t) {
    glm::dvec4 sum(0);
    for (Inside& inside : inside_) {
      move(inside, t);
      const Prism& prism = tracer_.prisms_[inside.prism];
      const glm::dvec3 uvw = over_prism(prism.texture, inside.point);
      glm::dvec4 at = tracer_.shell_.colours->at(uvw);
      if (lights_ && at.w > 0) {
        const glm::dvec3 gradient = over_prism(prism.cotangents, inside.point) * tracer_.shell_.colours->gradient(uvw);
        at = glm::dvec4(at.w * lights_->shade(gradient, t, glm::dvec3(at) / at.w), at.w);
      }
      sum += at;
    }
    return sum;
  }

  // Where the ray next passes from texel to texel, at most t1: from the texture coordinates' rates here, mended by
  // those there. What this misses, the halving of pieces makes up for.
  double next_texel(double t, double t1) {
    const glm::dvec3 size(tracer_.shell_.colours->size);
    double next = t1;
    for (Inside& inside : inside_) {
      const Prism& prism = tracer_.prisms_[inside.prism];
      const auto place = [&](double at, glm::dvec3& index, glm::dvec3& rate) {
        move(inside, at);
        const PrismPoint& p = inside.point;
        const glm::dmat3 j = prism.map.jacobian(p);
        const glm::dvec3 change = glm::inverse(j) * ray_.direction;
        index = over_prism(prism.texture, p) * size - 0.5;
        // The texture coordinates are mapped as positions are.
        rate = PrismMap(prism.texture).jacobian(p) * change * size;
      };
      glm::dvec3 index, rate;
      place(t, index, rate);
      for (int axis = 0; axis < 3; ++axis) {
        const double ahead = 1e-9 * (rate[axis] < 0 ? -1 : 1);
        const double wall = rate[axis] < 0 ? std::ceil(index[axis] + ahead) - 1 : std::floor(index[axis] + ahead) + 1;
        double at = t + (wall - index[axis]) / rate[axis];
        for (int i = 0; i < 3 && at > t && at < next; ++i) {
          glm::dvec3 there, rate_there;
          place(at, there, rate_there);
          const double miss = (wall - there[axis]) / rate_there[axis];
          at += miss;
          if (std::abs(miss) < 1e-12 * (1 + std::abs(at))) break;
        }
        if (at > t && at < next) next = at;
      }
    }
    // A texel that is only touched makes no piece of its own.
    const double least = t + 1e-9 * (t1 - t) + 4 * std::numeric_limits<double>::epsilon() * std::abs(t);
    return std::max(next, least);
  }

  void add_piece(double t0, double t1, const glm::dvec4& first, const glm::dvec4& last, int level) {
    if (saturated()) return;
    const double length = t1 - t0, middle = 0.5 * (t0 + t1);
    const Samples samples{first, sample(t0 + 0.25 * length), sample(middle), sample(t0 + 0.75 * length), last};
    const Fit fit(samples);
    const double end = std::max(length * fit.integral(1), 0.0);
    const double off = length * (largest(glm::dvec3(fit.off)) + std::abs(fit.off.w) * tracer_.max_radiance_);
    glm::dvec3 coarse(0), fine(0);
    for (const auto& [count, sum] : {std::pair{5, &coarse}, std::pair{8, &fine}}) {
      const GaussRule& rule = gauss_rule(count);
      for (size_t i = 0; i < static_cast<size_t>(count); ++i) {
        const double u = 0.5 * (1 + rule.node[i]);
        *sum += (0.5 * rule.weight[i] * length * std::exp(-length * fit.integral(u))) * fit.emission(u);
      }
    }
    const double error = transmittance() * (off + largest(fine - coarse));
    if (error > piece_error_ && level < kDeepestHalving) {
      add_piece(t0, middle, first, samples[2], level + 1);
      add_piece(middle, t1, samples[2], last, level + 1);
      return;
    }
    rgb_ += transmittance() * fine;
    bound_ += error;
    depth_ += end;
    ++pieces_;
  }

  const ShellTracer& tracer_;
  const Ray& ray_;
  double piece_error_, negligible_;
  std::optional<RayLights> lights_;
  std::vector<Inside> inside_;
  glm::dvec3 rgb_{0};
  double depth_ = 0, bound_ = 0;
  int64_t pieces_ = 0;
};

ShellTracer::ShellTracer(const Scene& scene) : scene_(scene), shell_(shell_of(scene)) {
  const bool lit = scene.effects.lighting.has_value();
  const std::vector<std::array<glm::dmat3, 6>> slopes =
      lit ? cotangents(shell_) : std::vector<std::array<glm::dmat3, 6>>(shell_.prisms());
  std::vector<Box> boxes;
  const std::vector<PrismFault> faults = prism_faults(shell_);
  for (size_t i = 0; i < shell_.prisms(); ++i) {
    if (faults[i] != PrismFault::None) continue;
    std::array<glm::dvec3, 6> corners;
    for (int k = 0; k < 6; ++k) corners[static_cast<size_t>(k)] = shell_.corner(i, k);
    prisms_.push_back({PrismMap(corners), shell_.texture[i], slopes[i]});
    boxes.push_back(box_of(corners));
  }
  boxes_.emplace(boxes);
  const ShellBounds bounds = bounds_of(shell_);
  middle_ = 0.5 * (bounds.lo + bounds.hi);
  radius_ = 0.51 * glm::distance(bounds.lo, bounds.hi);  // a hundredth more than the sphere around all corners
  if (lit) {
    floor_ = gradient_floor(*scene.effects.lighting, shell_);
    const LightingBound bound = lighting_bound(*scene.effects.lighting);
    max_radiance_ = std::max(1.0, bound.gain + bound.offset);
  }
}

std::vector<ShellTracer::Stretch> ShellTracer::stretches(const Ray& ray, double t0, double t1) const {
  struct OnFace {
    double t0, t1;
  };
  std::vector<Stretch> out;
  std::vector<OnFace> faces;
  std::vector<double> cuts;
  for (const size_t i : boxes_->on_ray(ray, t0, t1)) {
    cuts.assign({t0, t1});
    prisms_[i].map.append_crossings(ray, cuts);
    std::erase_if(cuts, [&](double t) { return !(t >= t0 && t <= t1); });
    std::sort(cuts.begin(), cuts.end());
    for (size_t k = 0; k + 1 < cuts.size(); ++k) {
      const double middle = 0.5 * (cuts[k] + cuts[k + 1]);
      if (!(cuts[k] < middle && middle < cuts[k + 1])) continue;
      PrismPoint point(0);
      const double depth = prisms_[i].map.locate(ray.origin + middle * ray.direction, point);
      if (depth < -kOnFace) continue;
      // A ray along a face that two prisms share is in both of them, or in neither: it is given to the first.
      if (depth < kOnFace) {
        const bool taken = std::any_of(faces.begin(), faces.end(),
                                       [&](const OnFace& face) { return face.t0 < middle && middle < face.t1; });
        if (taken) continue;
        faces.push_back({cuts[k], cuts[k + 1]});
      }
      out.push_back({i, cuts[k], cuts[k + 1]});
    }
  }
  return out;
}

RayResult ShellTracer::trace(const Ray& ray, double tolerance) const {
  const double middle_at = glm::dot(middle_ - ray.origin, ray.direction);
  double t0 = std::max(ray.t_near, middle_at - radius_), t1 = middle_at + radius_;
  for (const ClipPlane& plane : scene_.effects.clip_planes) {
    const double away = plane.distance - glm::dot(plane.normal, ray.origin);
    const double rate = glm::dot(plane.normal, ray.direction);
    if (rate > 0) t0 = std::max(t0, away / rate);
    if (rate < 0) t1 = std::min(t1, away / rate);
    if (rate == 0 && away > 0) return {};
  }
  const std::vector<Stretch> in = stretches(ray, t0, t1);
  std::vector<double> ends;
  for (const Stretch& stretch : in) {
    ends.push_back(stretch.t0);
    ends.push_back(stretch.t1);
  }
  std::sort(ends.begin(), ends.end());
  Walk walk(*this, ray, tolerance);
  std::vector<size_t> prisms;
  for (size_t k = 0; k + 1 < ends.size() && !walk.saturated(); ++k) {
    const double middle = 0.5 * (ends[k] + ends[k + 1]);
    prisms.clear();
    for (const Stretch& stretch : in)
      if (stretch.t0 <= middle && middle <= stretch.t1 && ends[k] < ends[k + 1]) prisms.push_back(stretch.prism);
    if (!prisms.empty()) walk.add(prisms, ends[k], ends[k + 1]);
  }
  RayResult result = walk.result();
  result.cells = static_cast<int64_t>(in.size());
  return result;
}

}  // namespace volumark
