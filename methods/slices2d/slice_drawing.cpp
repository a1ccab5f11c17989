#include "methods/slices2d/slice_drawing.h"

#include "methods/slices2d/page_uniforms.h"
#include "programs/slices2d_vert.h"

namespace volumark {

SliceDrawing::SliceDrawing(const Scene& scene, const SliceStacks& stacks, const SliceSettings& settings,
                           ProgramDesc program, Format target, Device& device)
    : scene_(scene),
      stacks_(stacks),
      settings_(settings),
      device_(device),
      uniforms_(device, "slice uniforms"),
      vertices_(device, "slice vertices"),
      indices_(device, "slice indices") {
  program.stages.insert(program.stages.begin(), &programs::slices2d_vert);
  program.constants.insert(program.constants.begin() + 6, {{"VM_TEXTURES", settings_.textures},
                                                           {"VM_INTERPOLATE", settings_.interpolate ? 1 : 0},
                                                           {"VM_CORRECTED", settings_.corrected ? 1 : 0}});
  program_ = device.create_program(program);
  // The destructor does not run when a constructor throws.
  try {
    PipelineDesc pipeline;
    pipeline.label = program.label;
    pipeline.program = program_;
    pipeline.vertex_layouts = {{sizeof(PolygonVertex), false, {{0, 2, 0}, {1, 2, offsetof(PolygonVertex, first)}}}};
    pipeline.blend = Blend::Over;
    pipeline.colour_format = target;
    pipeline_ = device.create_pipeline(pipeline);
  } catch (...) {
    device.destroy(program_);
    throw;
  }
}

SliceDrawing::~SliceDrawing() {
  device_.destroy(pipeline_);
  device_.destroy(program_);
}

std::vector<std::byte> SliceDrawing::uniforms_of(const View& view, const Slices& slices, const StackLayout& layout,
                                                 int width, int height) const {
  VolumeUniforms uniforms = turned(volume_uniforms(scene_, view, width, height), layout.axis);
  stacks_.fill(uniforms);
  // Lengths of rays count across the slices only; nothing else in programs without light reads the extent.
  if (!settings_.slant) uniforms.extent[0] = uniforms.extent[1] = 0;
  uniforms.own[0] = {2.F / static_cast<float>(width), -2.F / static_cast<float>(height),
                     static_cast<float>(slices.stored_at(0)), static_cast<float>(slices.stored - 1)};
  uniforms.own[3] = {static_cast<float>(slices.first), static_cast<float>(slices.distance),
                     static_cast<float>(slices.distance * (slices.stored - 1)), 0};
  return page_blocks(layout, uniforms);
}

void SliceDrawing::render(const View& view, Device& device, Texture target) {
  const int width = device.desc(target).width, height = device.desc(target).height;
  device.begin_zone("classify");
  const ViewRays rays = view_rays(*scene_.volume, view, width, height);
  const int axis = best_stack(*scene_.volume, rays);
  const StackLayout& layout = stacks_.layout(axis);
  const Slices slices = slices_of(layout.slices, settings_.percent);
  const ViewRays stack_rays = turned(rays, axis);
  const glm::dvec3 extent = turned(scene_.volume->extent(), axis);
  const std::vector<SliceGroup> groups = slice_groups(slices, layout, stack_rays, extent, settings_.textures);
  // An eighth of a pixel more: rasterizers move corners, and fragments know themselves where the volume ends.
  build_groups(slices, groups, stack_rays, extent, settings_.corrected, {0.25 / width, 0.25 / height}, mesh_);
  device.end_zone();

  DrawDesc draw;
  Buffer blocks;
  if (!mesh_.indices.empty()) {
    device.begin_zone("upload");
    blocks = uniforms_.upload(uniforms_of(view, slices, layout, width, height));
    draw.pipeline = pipeline_;
    draw.vertex_buffers = {vertices_.upload(bytes_of(mesh_.vertices))};
    draw.index_buffer = indices_.upload(bytes_of(mesh_.indices));
    device.end_zone();
  }
  device.begin_zone("raster");
  PassDesc pass;
  pass.label = "slices";
  pass.colour = target;
  device.begin_pass(pass);
  for (const SliceRun& run : mesh_.runs) {
    draw.bindings = stacks_.bindings(axis, run.page, bind_page_block(blocks, run.page));
    draw.first = run.first_index;
    draw.count = run.index_count;
    device.draw(draw);
  }
  device.end_pass();
  device.end_zone();

  counters_ = {{"stack_axis", axis},
               {"slices", slices.count},
               {"polygons", mesh_.polygons},
               {"vertices", static_cast<int64_t>(mesh_.vertices.size())},
               {"draws", static_cast<int64_t>(mesh_.runs.size())},
               {"texture_bytes", static_cast<int64_t>(stacks_.texture_bytes())}};
}

}  // namespace volumark
