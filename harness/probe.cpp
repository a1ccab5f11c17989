#include "harness/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/frame.h"
#include "methods/reference/lattice.h"
#include "methods/reference/reference.h"

namespace volumark {
namespace {

// Distances along the ray between which it is in what box, near plane and clip planes leave of the volume.
std::optional<std::pair<double, double>> span_of(const Scene& scene, const Ray& ray) {
  double t0 = ray.t_near, t1 = std::numeric_limits<double>::infinity();
  const auto keep = [&](double from, double rate) {  // where from + t rate >= 0
    if (rate > 0) t0 = std::max(t0, -from / rate);
    if (rate < 0) t1 = std::min(t1, -from / rate);
    if (rate == 0 && from < 0) t1 = t0;
  };
  const Lattice lattice(*scene.volume);
  const glm::dvec3 origin = lattice.index_of_point(ray.origin), direction = lattice.index_of_vector(ray.direction);
  for (int axis = 0; axis < 3; ++axis) {
    keep(origin[axis], direction[axis]);
    keep(lattice.cells()[axis] - origin[axis], -direction[axis]);
  }
  for (const ClipPlane& plane : scene.effects.clip_planes)
    keep(glm::dot(plane.normal, ray.origin) - plane.distance, glm::dot(plane.normal, ray.direction));
  if (!(t0 < t1)) return std::nullopt;
  return std::pair(t0, t1);
}

double trilinear(const Lattice::Corners& corner, const glm::dvec3& at) {
  const auto along_x = [&](size_t k) { return glm::mix(corner[k], corner[k + 1], at.x); };
  return glm::mix(glm::mix(along_x(0), along_x(2), at.y), glm::mix(along_x(4), along_x(6), at.y), at.z);
}

// The data along one ray.
class RayData {
 public:
  RayData(const Scene& scene, const Ray& ray, double cosine)
      : scene_(scene), lattice_(*scene.volume), ray_(ray), cosine_(cosine) {}

  ProbePoint at(double depth) const {
    const Place place = place_of(depth);
    Lattice::Corners corners;
    lattice_.load(place.cell, corners);
    const double value = trilinear(corners, place.inside);
    const glm::dvec4 point = scene_.transfer.at(value);
    return {depth, value, glm::dvec3(point), point.w};
  }
  glm::dvec3 gradient(double depth) const {
    const Place place = place_of(depth);
    Lattice::CornerGradients corners;
    lattice_.load_gradients(place.cell, corners);
    const glm::dvec3 local(trilinear(corners[0], place.inside), trilinear(corners[1], place.inside),
                           trilinear(corners[2], place.inside));
    return scene_.volume->axes * local;
  }

 private:
  struct Place {
    glm::ivec3 cell;
    glm::dvec3 inside;  // [0, 1]^3
  };
  Place place_of(double depth) const {
    const glm::dvec3 cells(lattice_.cells());
    const glm::dvec3 world = ray_.origin + ray_.direction * (depth / cosine_);
    const glm::dvec3 index = glm::clamp(lattice_.index_of_point(world), glm::dvec3(0), cells);
    const glm::dvec3 cell = glm::min(glm::floor(index), cells - 1.0);
    return {glm::ivec3(cell), index - cell};
  }

  const Scene& scene_;
  Lattice lattice_;
  Ray ray_;
  double cosine_;  // of the angle between ray and view direction: depth = cosine * distance
};

using PixelUpTo = std::function<ProbeSample(double depth)>;

PixelUpTo method_pixel(const Scene& scene, const View& view, const ProbeSubject& subject, Device& device,
                       const ProbeOptions& options) {
  return [&scene, &view, &subject, &device, options](double depth) {
    FrameSource source(scene_up_to(scene, view, depth), *subject.method, subject.values, device, options.width,
                       options.height);
    source.frame(view);
    const Image image = source.read_back();
    const float* rgba = image.pixel(options.x, options.y);
    const auto channel = [&](int c) { return static_cast<double>(rgba[c]); };
    return ProbeSample{{channel(0), channel(1), channel(2)}, 1 - channel(3), 0};
  };
}

PixelUpTo reference_pixel(const Scene& scene, const View& view, const Ray& ray, double tolerance) {
  return [&scene, &view, ray, tolerance](double depth) {
    const RayIntegral sum = integrate_ray(scene_up_to(scene, view, depth), view, ray, tolerance);
    return ProbeSample{{sum.rgba[0], sum.rgba[1], sum.rgba[2]}, 1 - sum.rgba[3], sum.bound};
  };
}

void check(const Scene& scene, const std::vector<ProbeSubject>& subjects, const Device* device,
           const ProbeOptions& options) {
  if (subjects.empty()) throw ProbeError("a probe needs a method");
  if (!scene.volume) throw ProbeError("the scene shows a shell: a profile follows the data of a volume");
  if (options.depths < 2) throw ProbeError("a profile has at least two depths");
  if (!(options.threshold > 0)) throw ProbeError("the threshold must be positive");
  if (options.x < 0 || options.y < 0 || options.x >= options.width || options.y >= options.height)
    throw ProbeError(fmt::format("pixel {},{} is not in the picture: it is {}x{}, so pixels go from 0,0 to {},{}",
                                 options.x, options.y, options.width, options.height, options.width - 1,
                                 options.height - 1));
  for (const ProbeSubject& subject : subjects) {
    if (subject.method == nullptr) continue;
    const MethodInfo& info = subject.method->info();
    if (std::find(info.effects.begin(), info.effects.end(), "clip_planes") == info.effects.end())
      throw ProbeError(fmt::format(
          "{} does not simulate clip_planes: a profile cuts the volume at each depth with a clip plane", info.name));
    if (device == nullptr) throw ProbeError(fmt::format("{} needs a backend to draw on", info.name));
    // With one plane more, which may be one too many.
    if (const auto reason =
            unsupported_reason(*subject.method, scene_up_to(scene, View{}, 0), subject.values, device->info()))
      throw ProbeError(fmt::format("{} on {}: unsupported: {}", info.name, device->info().id, *reason));
  }
}

// Where |a - b| crosses the threshold between `near` (not above it) and `far` (above it).
double crossing(const PixelUpTo& a, const PixelUpTo& b, double threshold, double precision, double near, double far) {
  for (int i = 0; i < 60 && far - near > precision; ++i) {
    const double middle = 0.5 * (near + far);
    if (middle <= near || middle >= far) break;
    (difference_of(a(middle), b(middle)) <= threshold ? near : far) = middle;
  }
  return far;
}

}  // namespace

double difference_of(const ProbeSample& a, const ProbeSample& b) {
  const glm::dvec3 colour = glm::abs(a.colour - b.colour);
  double largest = 0;
  for (const double d : {colour.r, colour.g, colour.b, std::abs(a.transmittance - b.transmittance)}) {
    if (std::isnan(d)) return d;
    largest = std::max(largest, d);
  }
  return largest;
}

Scene scene_up_to(const Scene& scene, const View& view, double depth) {
  const glm::dvec3 forward = frame_of(view).forward;
  Scene cut = scene;
  cut.effects.clip_planes.push_back({-forward, -(glm::dot(forward, view.eye) + depth)});
  return cut;
}

Probe probe(const Scene& scene, const View& view, const std::vector<ProbeSubject>& subjects, Device* device,
            const ProbeOptions& options) {
  check(scene, subjects, device, options);
  const Ray ray = pixel_ray(view, options.width, options.height, options.x, options.y);
  const double cosine = glm::dot(ray.direction, frame_of(view).forward);
  const auto span = span_of(scene, ray);
  if (!span)
    throw ProbeError(fmt::format("the ray of pixel {},{} misses the volume: nothing to profile", options.x, options.y));

  Probe out;
  out.options = options;
  out.first = span->first * cosine;
  out.last = span->second * cosine;
  const RayData data(scene, ray, cosine);
  for (int i = 0; i < options.depths; ++i)
    out.ray.push_back(data.at(glm::mix(out.first, out.last, static_cast<double>(i) / (options.depths - 1))));

  std::vector<PixelUpTo> pixels;
  for (const ProbeSubject& subject : subjects) {
    pixels.push_back(subject.method != nullptr ? method_pixel(scene, view, subject, *device, options)
                                               : reference_pixel(scene, view, ray, options.tolerance));
    ProbeCurve curve{
        subject.label, subject.method != nullptr ? subject.method->info().name : "reference", subject.values, {}};
    for (const ProbePoint& point : out.ray) curve.samples.push_back(pixels.back()(point.depth));
    out.curves.push_back(std::move(curve));
  }
  if (subjects.size() < 2) return out;

  for (size_t i = 0; i < out.ray.size(); ++i) {
    // Also where one of them is not a number.
    if (difference_of(out.curves[0].samples[i], out.curves[1].samples[i]) <= options.threshold) continue;
    const Volume& volume = *scene.volume;
    const double voxel = std::min({volume.spacing.x, volume.spacing.y, volume.spacing.z});
    const double depth = i == 0 ? out.first
                                : crossing(pixels[0], pixels[1], options.threshold, options.precision * voxel,
                                           out.ray[i - 1].depth, out.ray[i].depth);
    out.parting = Parting{depth, 0, 1, pixels[0](depth), pixels[1](depth), data.at(depth), data.gradient(depth)};
    break;
  }
  return out;
}

}  // namespace volumark
