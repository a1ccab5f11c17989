#include "harness/verify/brute_force.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <numbers>

namespace volumark::brute {
namespace {

using Real = long double;
using Vec = std::array<Real, 3>;

struct Rule {
  std::vector<Real> node, weight;  // on [0, 1]
};

Rule gauss(int n) {
  Rule rule;
  for (int i = 0; i < n; ++i) {
    Real x = std::cos(std::numbers::pi_v<Real> * (static_cast<Real>(i) + 0.75L) / (static_cast<Real>(n) + 0.5L));
    Real slope = 1;
    for (int k = 0; k < 50; ++k) {
      Real p0 = 1, p1 = x;
      for (int m = 2; m <= n; ++m) {
        const Real p2 = ((2 * m - 1) * x * p1 - (m - 1) * p0) / m;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (x * p1 - p0) / (x * x - 1);
      x -= p1 / slope;
    }
    rule.node.push_back((1 + x) / 2);
    rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

struct Tracer {
  const Scene& scene;
  const Ray& ray;
  Vec origin{}, direction{};  // index space, single-sample axes shifted by half a cell
  glm::ivec3 cells;

  Tracer(const Scene& s, const Ray& r) : scene(s), ray(r), cells(glm::max(s.volume->size - 1, glm::ivec3(1))) {
    const Volume& v = *scene.volume;
    for (int a = 0; a < 3; ++a) {
      Real o = 0, d = 0;
      for (int k = 0; k < 3; ++k) {
        o += static_cast<Real>(v.axes[a][k]) * (static_cast<Real>(ray.origin[k]) - static_cast<Real>(v.origin[k]));
        d += static_cast<Real>(v.axes[a][k]) * static_cast<Real>(ray.direction[k]);
      }
      const size_t i = static_cast<size_t>(a);
      origin[i] = o / static_cast<Real>(v.spacing[a]) + (v.size[a] == 1 ? 0.5L : 0.0L);
      direction[i] = d / static_cast<Real>(v.spacing[a]);
    }
  }

  // Trilinear interpolation of f(i, j, k) in this cell.
  template <typename F>
  Real interpolate(const glm::ivec3& cell, Real t, F&& f) const {
    Real sum = 0;
    for (int c = 0; c < 8; ++c) {
      Real weight = 1;
      for (int a = 0; a < 3; ++a) {
        const size_t i = static_cast<size_t>(a);
        const Real x = origin[i] + t * direction[i] - cell[a];
        weight *= (c >> a) & 1 ? x : 1 - x;
      }
      sum += weight * f(cell.x + (c & 1), cell.y + ((c >> 1) & 1), cell.z + (c >> 2));
    }
    return sum;
  }
  Real value(const glm::ivec3& cell, Real t) const {
    return interpolate(cell, t, [&](int i, int j, int k) { return static_cast<Real>(scene.volume->at(i, j, k)); });
  }
  glm::dvec3 gradient(const glm::ivec3& cell, Real t) const {
    const Volume& v = *scene.volume;
    glm::dvec3 g(0);
    for (int a = 0; a < 3; ++a) {
      glm::ivec3 e(0);
      e[a] = 1;
      const Real slope = interpolate(cell, t, [&](int i, int j, int k) {
        if (v.size[a] == 1) return 0.0L;
        const glm::ivec3 p = glm::min(glm::ivec3(i, j, k), v.size - 1);
        return static_cast<Real>(v.at(p.x + e.x, p.y + e.y, p.z + e.z) - v.at(p.x - e.x, p.y - e.y, p.z - e.z)) /
               (2 * static_cast<Real>(v.spacing[a]));
      });
      g += v.axes[a] * static_cast<double>(slope);
    }
    return g;
  }

  // Of the gradient's length, data units a world unit.
  double floor() const {
    const glm::dvec3 spacing = scene.volume->spacing;
    const double window = scene.transfer.hi - scene.transfer.lo;
    return scene.effects.lighting->gradient_floor * window / std::min({spacing.x, spacing.y, spacing.z});
  }

  glm::dvec3 lit(const glm::dvec3& colour, const glm::dvec3& g, Real t) const {
    const Lighting& l = *scene.effects.lighting;
    const glm::dvec3 p = ray.origin + static_cast<double>(t) * ray.direction;
    glm::dvec3 out = colour * l.ambient;
    const glm::dvec3 n = g / -std::max(glm::length(g), floor());
    for (const Light& light : l.lights) {
      const glm::dvec3 to_light =
          light.kind == Light::Kind::Point ? glm::normalize(light.vector - p) : glm::normalize(light.vector);
      const double n_l = glm::dot(n, to_light), n_h = glm::dot(n, glm::normalize(to_light - ray.direction));
      const double diffuse = l.two_sided ? std::abs(n_l) : std::max(0.0, n_l);
      const double highlight = l.two_sided ? std::abs(n_h) : (n_l > 0 ? std::max(0.0, n_h) : 0.0);
      out += light.colour * (colour * (l.diffuse * diffuse) + l.specular * std::pow(highlight, l.shininess));
    }
    return out;
  }
};

// Where g . l or g . h changes sign for some light, or |g| passes the floor: shading bends or jumps there.
template <class Side>
void append_changes(const Side& side, Real t0, Real t1, std::vector<Real>& cuts) {
  constexpr int samples = 48;
  for (int i = 0; i < samples; ++i) {
    Real a = t0 + (t1 - t0) * i / samples, b = t0 + (t1 - t0) * (i + 1) / samples;
    const bool before = side(a);
    if (before == side(b)) continue;
    for (int k = 0; k < 60; ++k) {
      const Real m = (a + b) / 2;
      (side(m) == before ? a : b) = m;
    }
    cuts.push_back((a + b) / 2);
  }
}

void append_shading_cuts(const Tracer& tracer, const glm::ivec3& cell, Real t0, Real t1, std::vector<Real>& cuts) {
  const double floor = tracer.floor();
  append_changes([&](Real t) { return glm::length(tracer.gradient(cell, t)) > floor; }, t0, t1, cuts);
  for (const Light& light : tracer.scene.effects.lighting->lights) {
    for (const bool half : {false, true}) {
      const auto side = [&](Real t) {
        const glm::dvec3 p = tracer.ray.origin + static_cast<double>(t) * tracer.ray.direction;
        const glm::dvec3 l = glm::normalize(light.kind == Light::Kind::Point ? light.vector - p : light.vector);
        return glm::dot(tracer.gradient(cell, t), half ? l - tracer.ray.direction : l) > 0;
      };
      append_changes(side, t0, t1, cuts);
    }
  }
}

// Where s(t) turns or takes a control value of the transfer function, by sampling and bisection.
std::vector<Real> cuts_of(const Tracer& tracer, const glm::ivec3& cell, Real t0, Real t1) {
  // Evenly, and close to both ends, where a bump between two samples would else be missed.
  constexpr int samples = 24;
  std::vector<Real> at{t0, t1};
  for (int i = 1; i < samples; ++i) at.push_back(t0 + (t1 - t0) * i / samples);
  for (const Real near : {1e-7L, 1e-5L, 1e-3L}) {
    at.push_back(t0 + (t1 - t0) * near);
    at.push_back(t1 - (t1 - t0) * near);
  }
  std::sort(at.begin(), at.end());
  std::vector<Real> turns{t0};
  auto s = [&](Real t) { return tracer.value(cell, t); };
  for (size_t i = 1; i + 1 < at.size(); ++i) {
    const Real before = s(at[i - 1]), now = s(at[i]), after = s(at[i + 1]);
    if ((now - before) * (after - now) > 0) continue;
    const Real sign = now >= before || now >= after ? 1 : -1;  // an extremum here: golden-section search
    Real a = at[i - 1], b = at[i + 1];
    for (int k = 0; k < 90; ++k) {
      const Real x = a + (b - a) * 0.381966L, y = a + (b - a) * 0.618034L;
      (sign * s(x) < sign * s(y) ? a : b) = sign * s(x) < sign * s(y) ? x : y;
    }
    turns.push_back((a + b) / 2);
  }
  turns.push_back(t1);
  std::sort(turns.begin(), turns.end());
  std::vector<Real> cuts = turns;
  for (const TransferPoint& p : tracer.scene.transfer.points) {
    const Real value = static_cast<Real>(p.value);
    for (size_t i = 0; i + 1 < turns.size(); ++i) {
      Real a = turns[i], b = turns[i + 1];
      if ((s(a) - value) * (s(b) - value) >= 0) continue;
      const bool rising = s(a) < value;
      for (int k = 0; k < 90; ++k) {
        const Real m = (a + b) / 2;
        ((s(m) < value) == rising ? a : b) = m;
      }
      cuts.push_back((a + b) / 2);
    }
  }
  if (tracer.scene.effects.lighting) append_shading_cuts(tracer, cell, t0, t1, cuts);
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

}  // namespace

std::array<long double, 4> brute_force(const Scene& scene, const Ray& ray, int fineness) {
  static const Rule rule4 = gauss(4), rule10 = gauss(10);
  const Tracer tracer(scene, ray);
  Real t0 = static_cast<Real>(ray.t_near), t1 = 1e30L;
  auto keep = [&](Real from, Real rate) {  // where from + t rate >= 0
    if (rate == 0) {
      if (from < 0) t1 = -1e30L;
    } else if (rate > 0) {
      t0 = std::max(t0, -from / rate);
    } else {
      t1 = std::min(t1, -from / rate);
    }
  };
  for (size_t a = 0; a < 3; ++a) {
    keep(tracer.origin[a], tracer.direction[a]);
    keep(tracer.cells[static_cast<int>(a)] - tracer.origin[a], -tracer.direction[a]);
  }
  for (const ClipPlane& plane : scene.effects.clip_planes) {
    Real at = -static_cast<Real>(plane.distance), rate = 0;
    for (int k = 0; k < 3; ++k) {
      at += static_cast<Real>(plane.normal[k]) * static_cast<Real>(ray.origin[k]);
      rate += static_cast<Real>(plane.normal[k]) * static_cast<Real>(ray.direction[k]);
    }
    keep(at, rate);
  }
  if (t0 >= t1) return {0, 0, 0, 0};
  std::vector<Real> planes{t0, t1};
  for (int a = 0; a < 3; ++a) {
    const size_t i = static_cast<size_t>(a);
    for (int k = 0; k <= tracer.cells[a]; ++k) {
      if (tracer.direction[i] == 0) continue;
      const Real t = (k - tracer.origin[i]) / tracer.direction[i];
      if (t > t0 && t < t1) planes.push_back(t);
    }
  }
  std::sort(planes.begin(), planes.end());

  Real depth = 0;
  std::array<Real, 4> out{};
  for (size_t c = 0; c + 1 < planes.size(); ++c) {
    const Real middle = (planes[c] + planes[c + 1]) / 2;
    if (planes[c + 1] - planes[c] < 1e-18L) continue;
    glm::ivec3 cell;
    for (int a = 0; a < 3; ++a) {
      const size_t i = static_cast<size_t>(a);
      cell[a] = std::clamp(static_cast<int>(std::floor(tracer.origin[i] + middle * tracer.direction[i])), 0,
                           tracer.cells[a] - 1);
    }
    const std::vector<Real> cuts = cuts_of(tracer, cell, planes[c], planes[c + 1]);
    for (size_t p = 0; p + 1 < cuts.size(); ++p) {
      const Real length = cuts[p + 1] - cuts[p];
      if (length <= 0) continue;
      // The transfer function on this side of a cut: taken between the ends, since rounding may put an end beyond it.
      auto at = [&](Real t) { return scene.transfer.at(static_cast<double>(tracer.value(cell, t))); };
      auto extinction = [&](Real t) { return static_cast<Real>(at(t).a); };
      const Real rough = extinction(cuts[p] + length / 2) * length;
      if (rough == 0 && extinction(cuts[p] + length / 4) == 0 && extinction(cuts[p] + 3 * length / 4) == 0) continue;
      const int parts = fineness * (2 + static_cast<int>(std::min(rough, 100.0L)));
      for (int k = 0; k < parts; ++k) {
        const Real a = cuts[p] + length * k / parts, h = length / parts;
        auto depth_over = [&](Real step) {
          Real sum = 0;
          for (size_t i = 0; i < 4; ++i) sum += rule4.weight[i] * step * extinction(a + step * rule4.node[i]);
          return sum;
        };
        for (size_t i = 0; i < rule10.node.size(); ++i) {
          const Real step = h * rule10.node[i];
          const glm::dvec4 transfer = at(a + step);
          if (transfer.a == 0) continue;
          glm::dvec3 colour(transfer);
          if (scene.effects.lighting) colour = tracer.lit(colour, tracer.gradient(cell, a + step), a + step);
          const Real weight =
              rule10.weight[i] * h * static_cast<Real>(transfer.a) * std::exp(-(depth + depth_over(step)));
          for (int ch = 0; ch < 3; ++ch) out[static_cast<size_t>(ch)] += weight * static_cast<Real>(colour[ch]);
        }
        depth += depth_over(h);
        if (depth > 60) return {out[0], out[1], out[2], 1};
      }
    }
  }
  out[3] = -std::expm1(-depth);
  return out;
}

namespace {

template <typename T>
void append(std::vector<std::byte>& bytes, T value) {
  const size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

template <typename F>
Volume float_volume(const glm::ivec3& size, F&& f) {
  Volume volume;
  volume.size = size;
  volume.type = VoxelType::F32;
  volume.min_value = 1e30;
  volume.max_value = -1e30;
  for (int k = 0; k < size.z; ++k) {
    for (int j = 0; j < size.y; ++j) {
      for (int i = 0; i < size.x; ++i) {
        const float value = static_cast<float>(f(i, j, k));
        append(volume.voxels, value);
        volume.min_value = std::min(volume.min_value, static_cast<double>(value));
        volume.max_value = std::max(volume.max_value, static_cast<double>(value));
      }
    }
  }
  return volume;
}

}  // namespace

Volume random_volume(const glm::ivec3& size, VoxelType type, std::mt19937_64& random) {
  Volume volume;
  volume.size = size;
  volume.type = type;
  volume.max_value = 1;
  const double levels = type == VoxelType::U8 ? 255 : type == VoxelType::U16 ? 65535 : 32767;
  if (type != VoxelType::F32) volume.slope = 1 / levels;
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < size.x * size.y * size.z; ++i) {
    const double value = uniform(random);
    switch (type) {
      case VoxelType::U8:
        append(volume.voxels, static_cast<uint8_t>(std::lround(value * levels)));
        break;
      case VoxelType::U16:
        append(volume.voxels, static_cast<uint16_t>(std::lround(value * levels)));
        break;
      case VoxelType::I16:
        append(volume.voxels, static_cast<int16_t>(std::lround(value * levels)));
        break;
      case VoxelType::F32:
        append(volume.voxels, static_cast<float>(value));
        break;
    }
  }
  return volume;
}

Volume constant_volume(const glm::ivec3& size, double value) {
  return float_volume(size, [&](int, int, int) { return value; });
}

Volume unit_ramp(const glm::ivec3& size) {
  Volume volume = float_volume(size, [&](int i, int, int) { return static_cast<double>(i) / (size.x - 1); });
  volume.spacing = 1.0 / glm::dvec3(glm::max(size - 1, glm::ivec3(1)));
  return volume;
}

Volume distance_volume(int n, double half) {
  const double spacing = 2 * half / (n - 1);
  Volume volume = float_volume(glm::ivec3(n),
                               [&](int i, int j, int k) { return glm::length(glm::dvec3(i, j, k) * spacing - half); });
  volume.spacing = glm::dvec3(spacing);
  volume.origin = glm::dvec3(-half);
  return volume;
}

Scene scene_of(Volume volume, std::vector<TransferPoint> points) {
  Scene scene;
  scene.name = "test";
  scene.volume = std::make_shared<Volume>(std::move(volume));
  scene.transfer.points = std::move(points);
  return scene;
}

Ray ray_between(const glm::dvec3& from, const glm::dvec3& to) { return {from, glm::normalize(to - from), 0}; }

}  // namespace volumark::brute
