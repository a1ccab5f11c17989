#include "methods/slices2d/slices2d.h"

#include "methods/slices2d/slice_polygons.h"
#include "methods/slices2d/stacks.h"
#include "methods/volume/growing_buffer.h"
#include "methods/volume/volume_parameters.h"
#include "programs/slices2d_frag.h"
#include "programs/slices2d_vert.h"

namespace volumark {
namespace {

namespace parameters {
using namespace volume_parameters;

const Integer& slices() {
  static const Integer parameter{{"slices",
                                  "percent",
                                  "slices to draw for each 100 stored ones; those between are interpolated",
                                  100,
                                  1,
                                  12800,
                                  {100, 200, 400, 800},
                                  Ideal<int64_t>{800, "step"}}};
  return parameter;
}
const Choice& textures_per_polygon() {
  static const Choice parameter{
      "textures_per_polygon", "slices on one polygon, combined in the program before one blend", {"1", "2", "4"}, "1"};
  return parameter;
}
const Choice& texture_coordinates() {
  static const Choice parameter{
      "texture_coordinates",
      "with several slices on a polygon; corrected: each is seen where it lies; uncorrected: all where the first one "
      "lies",
      {"corrected", "uncorrected"},
      "corrected",
      Ideal<const char*>{"corrected", "texture coordinates"}};
  return parameter;
}
const Flag& interpolation() {
  static const Flag parameter{"interpolation",
                              "on: slices between two stored ones are blended from them; off: the nearest stored one",
                              true, Ideal<bool>{true, "interpolation of slices"}};
  return parameter;
}
const Choice& classification() {
  static const Choice parameter{"classification",
                                "post: the transfer function is applied to interpolated samples; pre: to the voxels, "
                                "whose associated colours are "
                                "interpolated (paletted textures)",
                                {"post", "pre"},
                                "post",
                                Ideal<const char*>{"post", "classification"}};
  return parameter;
}
}  // namespace parameters

Classification classification_in(const Values& values) {
  return parameters::classification().index(values) == 0 ? Classification::Post : Classification::Pre;
}
bool linear_opacity(const Values& values) { return parameters::kOpacityCorrection(values) == "linear"; }
bool corrects(const Values& values) { return parameters::texture_coordinates()(values) == "corrected"; }
int textures_of(const Values& values) { return 1 << parameters::textures_per_polygon().index(values); }

double expected_order(const Values& values) {
  // Formats with few bits have an error that no number of slices removes; pre-classified volumes, slices that are not
  // interpolated and textures that are not corrected tend to other pictures.
  const std::string& format = parameters::kVolumeFormat(values);
  if (classification_in(values) == Classification::Pre || parameters::kTargetFormat(values) != "rgba32f" ||
      (format != "native" && format != "r32f") || !parameters::interpolation()(values) ||
      (textures_of(values) > 1 && !corrects(values))) {
    return 0;
  }
  return linear_opacity(values) ? 1 : 2;
}

VolumeSettings settings_of(const Values& values) {
  VolumeSettings settings;
  settings.volume_format = parameters::kVolumeFormat(values);
  settings.classification = classification_in(values);
  settings.table_size = static_cast<int>(parameters::kTableSize(values));
  return settings;
}

// Uniform blocks of several pages in one buffer.
constexpr size_t kBlock = (sizeof(VolumeUniforms) + 255) / 256 * 256;

class PreparedSlices2d final : public PreparedMethod {
 public:
  PreparedSlices2d(const Scene& scene, const Values& values, Device& device)
      : scene_(scene),
        device_(device),
        percent_(parameters::slices()(values)),
        textures_(textures_of(values)),
        corrected_(textures_ == 1 || corrects(values)),
        stacks_(scene, settings_of(values), device),
        uniforms_(device, "slice uniforms"),
        vertices_(device, "slice vertices"),
        indices_(device, "slice indices") {
    ProgramDesc program;
    program.label = "slices2d";
    program.stages = {&programs::slices2d_vert, &programs::slices2d_frag};
    program.bindings = SliceStacks::declarations();
    program.constants = VolumeResources::constants(scene, classification_in(values), linear_opacity(values));
    program.constants.push_back({"VM_TEXTURES", textures_});
    program.constants.push_back({"VM_INTERPOLATE", parameters::interpolation()(values) ? 1 : 0});
    program.constants.push_back({"VM_CORRECTED", corrected_ ? 1 : 0});
    program.cpu = &slices2d_twin;
    program_ = device.create_program(program);
    PipelineDesc pipeline;
    pipeline.label = "slices2d";
    pipeline.program = program_;
    pipeline.vertex_layouts = {{sizeof(PolygonVertex), false, {{0, 2, 0}, {1, 2, offsetof(PolygonVertex, first)}}}};
    pipeline.blend = Blend::Over;
    pipeline.colour_format = target_format_of(values);
    pipeline_ = device.create_pipeline(pipeline);
  }
  ~PreparedSlices2d() override {
    device_.destroy(pipeline_);
    device_.destroy(program_);
  }
  PreparedSlices2d(const PreparedSlices2d&) = delete;
  PreparedSlices2d& operator=(const PreparedSlices2d&) = delete;

  void render(const View& view, Device& device, Texture target) override;
  Counters counters() const override { return counters_; }

 private:
  std::vector<std::byte> uniforms_of(const View& view, const Slices& slices, const StackLayout& layout, int width,
                                     int height) const;

  Scene scene_;  // shares the volume
  Device& device_;
  int64_t percent_;
  int textures_;
  bool corrected_;
  SliceStacks stacks_;
  GrowingBuffer uniforms_, vertices_, indices_;
  Program program_;
  Pipeline pipeline_;
  SliceGroupMesh mesh_;
  Counters counters_;
};

// The block of each page of the stack, kBlock bytes apart.
std::vector<std::byte> PreparedSlices2d::uniforms_of(const View& view, const Slices& slices, const StackLayout& layout,
                                                     int width, int height) const {
  VolumeUniforms uniforms = turned(volume_uniforms(scene_, view, width, height), layout.axis);
  stacks_.fill(uniforms);
  uniforms.own[0] = {2.F / static_cast<float>(width), -2.F / static_cast<float>(height),
                     static_cast<float>(slices.stored_at(0)), static_cast<float>(slices.stored - 1)};
  std::vector<std::byte> blocks(kBlock * layout.pages.size());
  for (size_t i = 0; i < layout.pages.size(); ++i) {
    const StackPage& page = layout.pages[i];
    const glm::dvec2 texel = 1. / glm::dvec2(layout.extent(page));
    const glm::dvec2 tile = texel * glm::dvec2(layout.tile()), slice = texel * glm::dvec2(layout.slice);
    uniforms.own[1] = {static_cast<float>(tile.x), static_cast<float>(tile.y), static_cast<float>(slice.x),
                       static_cast<float>(slice.y)};
    uniforms.own[2] = {static_cast<float>(texel.x), static_cast<float>(texel.y), static_cast<float>(page.columns),
                       static_cast<float>(page.first)};
    uniforms.own[3] = {static_cast<float>(slices.first), static_cast<float>(slices.distance),
                       static_cast<float>(slices.distance * (slices.stored - 1)), static_cast<float>(page.last)};
    const std::span<const std::byte> block = bytes_of(uniforms);
    std::copy(block.begin(), block.end(), blocks.begin() + static_cast<ptrdiff_t>(kBlock * i));
  }
  return blocks;
}

void PreparedSlices2d::render(const View& view, Device& device, Texture target) {
  const int width = device.desc(target).width, height = device.desc(target).height;
  device.begin_zone("classify");
  const ViewRays rays = view_rays(*scene_.volume, view, width, height);
  const int axis = best_stack(*scene_.volume, rays);
  const StackLayout& layout = stacks_.layout(axis);
  const Slices slices = slices_of(layout.slices, percent_);
  const ViewRays stack_rays = turned(rays, axis);
  const glm::dvec3 extent = turned(scene_.volume->extent(), axis);
  const std::vector<SliceGroup> groups = slice_groups(slices, layout, stack_rays, extent, textures_);
  // An eighth of a pixel more: rasterizers move corners, and fragments know themselves where the volume ends.
  build_groups(slices, groups, stack_rays, extent, corrected_, {0.25 / width, 0.25 / height}, mesh_);
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
    const Binding block = bind_uniform(0, blocks, kBlock * static_cast<size_t>(run.page), sizeof(VolumeUniforms));
    draw.bindings = stacks_.bindings(axis, run.page, block);
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

class Slices2d final : public Method {
 public:
  const MethodInfo& info() const override {
    static const MethodInfo info{
        "slices2d",
        "Object-aligned slices of 2D textures, the stack chosen for each view, blended back to front",
        "rezksalama2000",
        {parameters::slices().info(), parameters::textures_per_polygon().info(),
         parameters::texture_coordinates().info(), parameters::interpolation().info(),
         parameters::classification().info(), parameters::kOpacityCorrection.info(), parameters::kTargetFormat.info(),
         parameters::kVolumeFormat.info(), parameters::kTableSize.info()},
        {"clip_planes"},
        expected_order};
    return info;
  }
  std::optional<std::string> unsupported(const Scene& scene, const Values& values,
                                         const BackendInfo& backend) const override {
    return stacks_unsupported(scene, settings_of(values), backend);
  }
  std::unique_ptr<PreparedMethod> prepare(const Scene& scene, const Values& values, Device& device) const override {
    return std::make_unique<PreparedSlices2d>(scene, values, device);
  }
  Format target_format(const Values& values) const override { return target_format_of(values); }
};

}  // namespace

const Method& slices2d() {
  static const Slices2d method;
  return method;
}

}  // namespace volumark
