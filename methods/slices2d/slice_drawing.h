// Draws the slices of the stack that a view takes as polygons, with whatever fragment program works on them: pipeline,
// geometry, uniform blocks and draws of the methods on object-aligned slices. The fragment program is made of
// slice_polygon.glsl; its vertex program is slices2d.vert.
#pragma once

#include <vector>

#include "methods/method.h"
#include "methods/slices2d/slice_polygons.h"
#include "methods/volume/growing_buffer.h"

namespace volumark {

struct SliceSettings {
  int64_t percent = 100;    // slices for each 100 stored ones
  int textures = 1;         // slices on a polygon: 1, 2 or 4
  bool interpolate = true;  // between stored slices (rezksalama2000, eq. 1)
  bool corrected = true;    // of several slices on a polygon, each is seen where it lies (eq. 2); true for one
  bool slant = true;        // a slice is as opaque as each ray's path through its slab; false: as its thickness alone
};

class SliceDrawing {
 public:
  // `program`: fragment stage alone, bindings (those of `stacks` among them), constants 0..5 and from 9 on (6..8 are
  // put between them here), twin. `scene` is copied and shares the volume; `stacks` lives longer.
  SliceDrawing(const Scene& scene, const SliceStacks& stacks, const SliceSettings& settings, ProgramDesc program,
               Format target, Device& device);
  ~SliceDrawing();
  SliceDrawing(const SliceDrawing&) = delete;
  SliceDrawing& operator=(const SliceDrawing&) = delete;

  // PreparedMethod::render.
  void render(const View& view, Device& device, Texture target);
  const Counters& counters() const { return counters_; }

 private:
  std::vector<std::byte> uniforms_of(const View& view, const Slices& slices, const StackLayout& layout, int width,
                                     int height) const;

  Scene scene_;
  const SliceStacks& stacks_;
  SliceSettings settings_;
  Device& device_;
  GrowingBuffer uniforms_, vertices_, indices_;
  Program program_;
  Pipeline pipeline_;
  SliceGroupMesh mesh_;
  Counters counters_;
};

}  // namespace volumark
