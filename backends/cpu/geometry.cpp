#include "backends/cpu/geometry.h"

#include <algorithm>
#include <cmath>

#include "backends/defects.h"

namespace volumark {
namespace {

constexpr double kSmallestW = 1e-12;
constexpr double kGuardPixels = 28000;  // edge equations stay below 2^24 a pixel step
constexpr int kClipPlanes = 7;
constexpr int kMaxCorners = 3 + kClipPlanes;

struct ClipVertex {
  double position[4];
  double varyings[kMaxVaryings];
};

struct WindowVertex {
  double x, y;     // pixels
  int64_t sx, sy;  // snapped, 1 / 256 pixel
  double z, inverse_w;
};

class Assembler {
 public:
  Assembler(PassWork& work, uint32_t draw, Cull cull, const ShadedVertices& vertices)
      : work_(work),
        draw_(draw),
        cull_(cull),
        vertices_(vertices),
        guard_x_(2 * kGuardPixels / work.width - 1),
        guard_y_(2 * kGuardPixels / work.height - 1) {}

  void triangle(uint32_t a, uint32_t b, uint32_t c);
  void line(uint32_t a, uint32_t b);
  void point(uint32_t a);

 private:
  ClipVertex load(uint32_t index) const;
  double distance(const ClipVertex& vertex, int plane) const;
  ClipVertex between(const ClipVertex& inside, const ClipVertex& outside, int plane) const;
  uint32_t outside_mask(const ClipVertex& vertex) const;
  int clip_polygon(ClipVertex* corners, int count, uint32_t planes) const;
  WindowVertex window(const ClipVertex& vertex) const;
  // `facing`: take front or back from the winding and cull; otherwise always a front face.
  void emit(const ClipVertex* const clip[3], const WindowVertex window[3], bool facing);
  void emit_planes(const ClipVertex* const clip[3], const WindowVertex window[3], bool perspective);

  PassWork& work_;
  uint32_t draw_;
  Cull cull_;
  const ShadedVertices& vertices_;
  double guard_x_, guard_y_;
};

ClipVertex Assembler::load(uint32_t index) const {
  ClipVertex vertex;
  for (size_t i = 0; i < 4; ++i) {
    vertex.position[i] = vertices_.position[4 * size_t{index} + i];
  }
  for (size_t i = 0; i < vertices_.varying_count; ++i) {
    vertex.varyings[i] = vertices_.varyings[vertices_.varying_count * index + i];
  }
  return vertex;
}

// Signed distance, >= 0 inside: w, near, far, then the guard band.
double Assembler::distance(const ClipVertex& vertex, int plane) const {
  const double* p = vertex.position;
  switch (plane) {
    case 0:
      return p[3] - kSmallestW;
    case 1:
      return p[2];
    case 2:
      return p[3] - p[2];
    case 3:
      return guard_x_ * p[3] + p[0];
    case 4:
      return guard_x_ * p[3] - p[0];
    case 5:
      return guard_y_ * p[3] + p[1];
    default:
      return guard_y_ * p[3] - p[1];
  }
}

uint32_t Assembler::outside_mask(const ClipVertex& vertex) const {
  uint32_t mask = 0;
  for (int plane = 0; plane < kClipPlanes; ++plane) {
    mask |= distance(vertex, plane) >= 0 ? 0U : 1U << plane;  // NaN counts as outside
  }
  return mask;
}

// Always from the inside vertex to the outside one: both polygons at a shared edge find the same point.
ClipVertex Assembler::between(const ClipVertex& inside, const ClipVertex& outside, int plane) const {
  const double from = distance(inside, plane);
  const double t = from / (from - distance(outside, plane));
  ClipVertex vertex;
  for (int i = 0; i < 4; ++i) {
    vertex.position[i] = inside.position[i] + t * (outside.position[i] - inside.position[i]);
  }
  for (size_t i = 0; i < vertices_.varying_count; ++i) {
    vertex.varyings[i] = inside.varyings[i] + t * (outside.varyings[i] - inside.varyings[i]);
  }
  return vertex;
}

// Sutherland and Hodgman 1974, against the planes in the mask. Returns the new number of corners.
int Assembler::clip_polygon(ClipVertex* corners, int count, uint32_t planes) const {
  ClipVertex result[kMaxCorners];
  for (int plane = 0; plane < kClipPlanes && count > 0; ++plane) {
    if ((planes & (1U << plane)) == 0) {
      continue;
    }
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      const ClipVertex& current = corners[i];
      const ClipVertex& next = corners[(i + 1) % count];
      const bool current_in = distance(current, plane) >= 0;
      const bool next_in = distance(next, plane) >= 0;
      if (current_in) {
        result[kept++] = current;
      }
      if (current_in != next_in) {
        result[kept++] = current_in ? between(current, next, plane) : between(next, current, plane);
      }
    }
    std::copy(result, result + kept, corners);
    count = kept;
  }
  return count;
}

int64_t snap(double pixels) { return std::llrint(pixels * (1 << kSubPixelBits)); }

WindowVertex Assembler::window(const ClipVertex& vertex) const {
  const double inverse_w = 1 / vertex.position[3];
  WindowVertex result{};
  result.x = (vertex.position[0] * inverse_w * 0.5 + 0.5) * work_.width;
  result.y = (0.5 - vertex.position[1] * inverse_w * 0.5) * work_.height;
  result.sx = snap(result.x);
  result.sy = snap(result.y);
  result.z = std::clamp(vertex.position[2] * inverse_w, 0.0, 1.0);
  result.inverse_w = inverse_w;
  return result;
}

// Edge from p to q with the inside where the function is positive: a polygon that turns clockwise on the screen.
Edge make_edge(const WindowVertex& p, const WindowVertex& q) {
  const int64_t dx = q.sx - p.sx;
  const int64_t dy = q.sy - p.sy;
  const bool top_left = dy < 0 || (dy == 0 && dx > 0);
  const bool holds_edge = (top_left && !defect(Defect::LostEdge)) || defect(Defect::DoubledEdge);
  // At sub-pixel (x, y): dx (y - p.y) - dy (x - p.x); centres lie at 256 i + 128. Dividing by 256 and rounding down
  // keeps the sign at every centre.
  const int64_t at_origin = dx * (128 - p.sy) - dy * (128 - p.sx) - (holds_edge ? 0 : 1);
  return {static_cast<int32_t>(-dy), static_cast<int32_t>(dx), at_origin >> kSubPixelBits};
}

void Assembler::emit(const ClipVertex* const clip[3], const WindowVertex window[3], bool facing) {
  const auto area_of = [&](const WindowVertex& a, const WindowVertex& b, const WindowVertex& c) {
    return (b.sx - a.sx) * (c.sy - a.sy) - (c.sx - a.sx) * (b.sy - a.sy);
  };
  const int64_t area = area_of(window[0], window[1], window[2]);
  const bool front = !facing || area < 0;  // y is down: counter-clockwise as seen is negative
  if (area == 0 || (facing && ((cull_ == Cull::Front && front) || (cull_ == Cull::Back && !front)))) {
    return;
  }
  Triangle triangle;
  const auto [min_x, max_x] = std::minmax({window[0].sx, window[1].sx, window[2].sx});
  const auto [min_y, max_y] = std::minmax({window[0].sy, window[1].sy, window[2].sy});
  // Centres c with min <= c <= max.
  const auto first_centre = [](int64_t s) { return (s - 128 + 255) >> kSubPixelBits; };
  const auto last_centre = [](int64_t s) { return (s - 128) >> kSubPixelBits; };
  triangle.x0 = static_cast<int32_t>(std::max<int64_t>(first_centre(min_x), 0));
  triangle.y0 = static_cast<int32_t>(std::max<int64_t>(first_centre(min_y), 0));
  triangle.x1 = static_cast<int32_t>(std::min<int64_t>(last_centre(max_x) + 1, work_.width));
  triangle.y1 = static_cast<int32_t>(std::min<int64_t>(last_centre(max_y) + 1, work_.height));
  if (triangle.x0 >= triangle.x1 || triangle.y0 >= triangle.y1) {
    return;
  }
  const int second = area > 0 ? 1 : 2;
  const int third = 3 - second;
  triangle.edges[0] = make_edge(window[0], window[second]);
  triangle.edges[1] = make_edge(window[second], window[third]);
  triangle.edges[2] = make_edge(window[third], window[0]);
  const auto [min_w, max_w] = std::minmax({window[0].inverse_w, window[1].inverse_w, window[2].inverse_w});
  // The difference to affine interpolation is below a quarter of this, relative: less than float resolves.
  triangle.perspective = max_w - min_w > 4e-7 * max_w;
  triangle.reference_x = window[0].x;
  triangle.reference_y = window[0].y;
  triangle.draw = draw_;
  triangle.front = front;
  triangle.first_plane = work_.planes.size();
  emit_planes(clip, window, triangle.perspective);
  work_.triangles.push_back(triangle);
}

void Assembler::emit_planes(const ClipVertex* const clip[3], const WindowVertex window[3], bool perspective) {
  double ax = window[1].x - window[0].x, ay = window[1].y - window[0].y;
  double bx = window[2].x - window[0].x, by = window[2].y - window[0].y;
  // Slopes come from the true positions, so that the triangles of one flat polygon agree; only where snapping changes
  // the shape do they come from the snapped ones.
  const double scale = 1.0 / (1 << kSubPixelBits);
  const double sax = static_cast<double>(window[1].sx - window[0].sx) * scale;
  const double say = static_cast<double>(window[1].sy - window[0].sy) * scale;
  const double sbx = static_cast<double>(window[2].sx - window[0].sx) * scale;
  const double sby = static_cast<double>(window[2].sy - window[0].sy) * scale;
  double area = ax * by - bx * ay;
  const double snapped_area = sax * sby - sbx * say;
  if (!(std::abs(area - snapped_area) < 0.1 * std::abs(snapped_area))) {
    ax = sax, ay = say, bx = sbx, by = sby, area = snapped_area;
  }
  const auto push = [&](double f0, double f1, double f2) {
    const double d1 = f1 - f0, d2 = f2 - f0;
    work_.planes.push_back({static_cast<float>(f0), static_cast<float>((d1 * by - d2 * ay) / area),
                            static_cast<float>((d2 * ax - d1 * bx) / area)});
  };
  push(window[0].z, window[1].z, window[2].z);
  push(window[0].inverse_w, window[1].inverse_w, window[2].inverse_w);
  for (size_t i = 0; i < vertices_.varying_count; ++i) {
    const auto value = [&](int k) { return clip[k]->varyings[i] * (perspective ? window[k].inverse_w : 1.0); };
    push(value(0), value(1), value(2));
  }
}

void Assembler::triangle(uint32_t a, uint32_t b, uint32_t c) {
  ClipVertex corners[kMaxCorners] = {load(a), load(b), load(c)};
  const uint32_t outside[3] = {outside_mask(corners[0]), outside_mask(corners[1]), outside_mask(corners[2])};
  if ((outside[0] & outside[1] & outside[2]) != 0) {
    return;
  }
  const uint32_t planes = outside[0] | outside[1] | outside[2];
  const int count = planes == 0 ? 3 : clip_polygon(corners, 3, planes);
  WindowVertex windows[kMaxCorners];
  for (int i = 0; i < count; ++i) {
    windows[i] = window(corners[i]);
  }
  for (int i = 1; i + 1 < count; ++i) {
    const ClipVertex* const clip[3] = {&corners[0], &corners[i], &corners[i + 1]};
    const WindowVertex fan[3] = {windows[0], windows[i], windows[i + 1]};
    emit(clip, fan, true);
  }
}

// A parallelogram one pixel high (or wide, along the other major axis): one pixel a column (row).
void Assembler::line(uint32_t a, uint32_t b) {
  ClipVertex ends[2] = {load(a), load(b)};
  for (int plane = 0; plane < kClipPlanes; ++plane) {
    const bool in[2] = {distance(ends[0], plane) >= 0, distance(ends[1], plane) >= 0};
    if (!in[0] && !in[1]) {
      return;
    }
    if (in[0] != in[1]) {
      const int outside = in[0] ? 1 : 0;
      ends[outside] = between(ends[1 - outside], ends[outside], plane);
    }
  }
  const WindowVertex w[2] = {window(ends[0]), window(ends[1])};
  const bool x_major = std::abs(w[1].x - w[0].x) >= std::abs(w[1].y - w[0].y);
  const auto moved = [&](const WindowVertex& vertex, double offset) {
    WindowVertex result = vertex;
    (x_major ? result.y : result.x) += offset;
    result.sx = snap(result.x);
    result.sy = snap(result.y);
    return result;
  };
  const WindowVertex low[2] = {moved(w[0], -0.5), moved(w[1], -0.5)};
  const WindowVertex high[2] = {moved(w[0], 0.5), moved(w[1], 0.5)};
  const ClipVertex* const first[3] = {&ends[0], &ends[1], &ends[1]};
  const WindowVertex first_window[3] = {low[0], low[1], high[1]};
  emit(first, first_window, false);
  const ClipVertex* const second[3] = {&ends[0], &ends[1], &ends[0]};
  const WindowVertex second_window[3] = {low[0], high[1], high[0]};
  emit(second, second_window, false);
}

// A square one pixel wide: exactly one pixel by the fill rule.
void Assembler::point(uint32_t a) {
  const ClipVertex centre = load(a);
  if (outside_mask(centre) != 0) {
    return;
  }
  const WindowVertex w = window(centre);
  const auto corner = [&](double dx, double dy) {
    WindowVertex result = w;
    result.x += dx;
    result.y += dy;
    result.sx = w.sx + static_cast<int64_t>(dx * 256);
    result.sy = w.sy + static_cast<int64_t>(dy * 256);
    return result;
  };
  const ClipVertex* const clip[3] = {&centre, &centre, &centre};
  const WindowVertex first[3] = {corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5)};
  const WindowVertex second[3] = {corner(-0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)};
  emit(clip, first, false);
  emit(clip, second, false);
}

}  // namespace

void append_primitives(PassWork& work, uint32_t draw, Topology topology, Cull cull, const ShadedVertices& vertices,
                       std::span<const uint32_t> corners) {
  Assembler assembler(work, draw, cull, vertices);
  const size_t count = corners.size();
  switch (topology) {
    case Topology::Points:
      for (const uint32_t corner : corners) assembler.point(corner);
      break;
    case Topology::Lines:
      for (size_t i = 0; i + 1 < count; i += 2) assembler.line(corners[i], corners[i + 1]);
      break;
    case Topology::Triangles:
      for (size_t i = 0; i + 2 < count; i += 3) assembler.triangle(corners[i], corners[i + 1], corners[i + 2]);
      break;
    case Topology::TriangleStrip:
      for (size_t i = 0; i + 2 < count; ++i) {
        // Every other triangle turns the other way.
        if (i % 2 == 0) {
          assembler.triangle(corners[i], corners[i + 1], corners[i + 2]);
        } else {
          assembler.triangle(corners[i + 1], corners[i], corners[i + 2]);
        }
      }
      break;
  }
}

}  // namespace volumark
