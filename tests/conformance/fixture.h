// What conformance tests share: a Device of the backend named by --backend, and drawing into a small target.
// A backend that cannot be had is a failure, never a skip: the suite is run for the backends one asks for.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "backends/device.h"
#include "backends/texel.h"
#include "tests/conformance/twins.h"
#include "tests/support/backend.h"

namespace volumark::conformance {

struct Vertex {
  float position[4];
  float colour[4];
};

enum class Kind { Flat, Window, Special, Sample1D, Sample2D, Sample3D };

// A target and the pass that is drawn into it.
class Canvas {
 public:
  explicit Canvas(int width, int height, Format format = Format::RGBA32F, bool depth_stencil = false);

  Device device;
  PassDesc pass;

  // A pipeline over flat.vert with this canvas' formats; change it with `edit` before it is created.
  Pipeline pipeline(Kind kind, const std::function<void(PipelineDesc&)>& edit = {},
                    std::vector<SpecConstant> constants = {});
  Program program(Kind kind, std::vector<SpecConstant> constants = {});
  Buffer vertices(const std::vector<Vertex>& vertices);
  void draw(Pipeline pipeline, const std::vector<Vertex>& vertices, std::vector<Binding> bindings = {});

  // Inside begin/end; `read` submits.
  void begin() { device.begin_pass(pass); }
  void end() { device.end_pass(); }
  std::vector<std::array<float, 4>> read();
  std::array<float, 4> at(const std::vector<std::array<float, 4>>& texels, int x, int y) const {
    return texels[static_cast<size_t>(y * width_ + x)];
  }

 private:
  int width_, height_;
  Format format_;
};

// Two triangles over [x0, x1] x [y0, y1] in NDC at depth z, counter-clockwise.
std::vector<Vertex> rectangle(float x0, float y0, float x1, float y1, std::array<float, 4> colour, float z = 0.5f);
std::vector<Vertex> screen(std::array<float, 4> colour, float z = 0.5f);

void expect_texel(const std::array<float, 4>& got, const std::array<float, 4>& want, float tolerance = 1e-6f);

// Runs `call` and expects a DeviceError of `kind` that names the call.
template <class F>
void expect_refused(DeviceErrorKind kind, const std::string& name, F&& call) {
  try {
    call();
    ADD_FAILURE() << name << " was not refused";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.kind, kind) << error.what();
    EXPECT_EQ(error.call, name) << error.what();
  }
}

}  // namespace volumark::conformance
