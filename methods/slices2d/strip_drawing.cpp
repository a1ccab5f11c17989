#include "methods/slices2d/strip_drawing.h"

#include <cstddef>

#include "methods/slices2d/page_uniforms.h"
#include "programs/strips_vert.h"

namespace volumark {

StripDrawing::StripDrawing(const SliceStacks& stacks, ProgramDesc program, Blend blend, Format target, Device& device)
    : stacks_(stacks),
      device_(device),
      uniforms_(device, "strip uniforms"),
      vertices_(device, "strip vertices"),
      indices_(device, "strip indices") {
  program.stages.insert(program.stages.begin(), &programs::strips_vert);
  PipelineDesc pipeline;
  pipeline.label = program.label;
  pipeline.program = program_ = device.create_program(program);
  pipeline.vertex_layouts = {{sizeof(StripVertex), false, {{0, 3, 0}, {1, 3, offsetof(StripVertex, depth)}}}};
  pipeline.blend = blend;
  pipeline.colour_format = target;
  // The destructor does not run when a constructor throws.
  try {
    pipeline_ = device.create_pipeline(pipeline);
  } catch (...) {
    device.destroy(program_);
    throw;
  }
}

StripDrawing::~StripDrawing() {
  device_.destroy(pipeline_);
  device_.destroy(program_);
}

void StripDrawing::draw(const StripBuilder& strips, int axis, const VolumeUniforms& uniforms, Texture target) {
  DrawDesc draw;
  Buffer blocks;
  if (!strips.indices().empty()) {
    device_.begin_zone("upload");
    blocks = uniforms_.upload(page_blocks(stacks_.layout(axis), uniforms));
    draw.pipeline = pipeline_;
    draw.vertex_buffers = {vertices_.upload(bytes_of(strips.vertices()))};
    draw.index_buffer = indices_.upload(bytes_of(strips.indices()));
    device_.end_zone();
  }
  device_.begin_zone("raster");
  PassDesc pass;
  pass.label = "strips";
  pass.colour = target;
  device_.begin_pass(pass);
  for (const SliceRun& run : strips.runs()) {
    draw.bindings = stacks_.bindings(axis, run.page, bind_page_block(blocks, run.page));
    draw.first = run.first_index;
    draw.count = run.index_count;
    device_.draw(draw);
  }
  device_.end_pass();
  device_.end_zone();
}

Counters StripDrawing::counters(const StripBuilder& strips, int axis) const {
  return {{"stack_axis", axis},
          {"polygons", strips.polygons()},
          {"strips", strips.strips()},
          {"vertices", static_cast<int64_t>(strips.vertices().size())},
          {"draws", static_cast<int64_t>(strips.runs().size())},
          {"texture_bytes", static_cast<int64_t>(stacks_.texture_bytes())}};
}

}  // namespace volumark
