#include "io/trajectory_outline.hpp"

#include "io/build_info.hpp"
#include "io/byte_writer.hpp"

#include <array>
#include <map>
#include <string_view>

namespace riesel::io {
namespace {

using Members = std::map<std::string, std::uint64_t>;

constexpr std::uint64_t all = trajectory_components;

/// Makes the objects of the tree one by one; one that appears in two places is made once.
class Tree {
public:
  Tree(Hdf5Outline& outline, const TrajectoryFacts& facts, const FixedArrays& fixed,
       const FrameBlocks& layout, const std::vector<std::uint64_t>& blocks, std::uint64_t frames)
      : out_(&outline),
        facts_(&facts),
        fixed_(&fixed),
        layout_(&layout),
        blocks_(&blocks),
        frames_(frames) {}

  std::uint64_t build() {
    make_scales();
    make_frames();
    Members root = amber_;
    root["h5md"] = h5md();
    root["parameters"] = parameters();
    root["particles"] = particles();
    return out_->add_group(root, Hdf5Attributes()
                                     .add("Conventions", "AMBER")
                                     .add("ConventionVersion", "1.0")
                                     .add("program", "riesel")
                                     .add("programVersion", build_info().version));
  }

private:
  std::uint64_t text(std::string_view letters, const std::string& scale) {
    return out_->add_data({.element = Hdf5Element::character,
                           .extent = {letters.size()},
                           .piece = out_->add_elements(letters),
                           .attributes = Hdf5Attributes().add_scale(scale, true)});
  }

  /// The scales of the dimensions that AMBER's names have.
  void make_scales() {
    const auto dimension = Hdf5Attributes().add_scale("", false);
    amber_["frame"] = out_->add_data({.element = Hdf5Element::real32,
                                      .extent = {frames_},
                                      .rows_per_chunk = layout_->frames_per_block,
                                      .attributes = dimension});
    amber_["atom"] = out_->add_data(
        {.element = Hdf5Element::real32, .extent = {facts_->grains}, .attributes = dimension});
    amber_["wall_grain"] = out_->add_data(
        {.element = Hdf5Element::real32, .extent = {facts_->wall_grains}, .attributes = dimension});
    amber_["spatial"] = text("xyz", "spatial");
    amber_["cell_spatial"] = text("abc", "cell_spatial");
    // The names of the angles, "alpha" to "gamma", would need another dimension; nobody reads them.
    amber_["cell_angular"] = text("abg", "cell_angular");
    const std::array<std::uint64_t, 6> order = {amber_["frame"],        amber_["atom"],
                                                amber_["wall_grain"],   amber_["spatial"],
                                                amber_["cell_spatial"], amber_["cell_angular"]};
    const auto scales = out_->add_references(order);
    frame_ = scales[0], atom_ = scales[1], wall_grain_ = scales[2], spatial_ = scales[3];
    cell_ = scales[4], angle_ = scales[5];
  }

  /// A unit in both conventions: H5MD's attribute and netCDF's.
  static Hdf5Attributes unit(const std::string& symbol, const std::string& name) {
    return Hdf5Attributes().add("unit", symbol).add("units", name);
  }

  /// An array with a row per frame, which is in each block at `offset`.
  std::uint64_t of_frames(std::uint64_t offset, Hdf5DataPlan plan) {
    std::vector<std::uint64_t> chunks;
    const auto used = (frames_ + layout_->frames_per_block - 1) / layout_->frames_per_block;
    for (std::uint64_t i = 0; i < used; ++i) chunks.push_back((*blocks_)[i] + offset);
    plan.rows_per_chunk = layout_->frames_per_block;
    plan.chunks = chunks;
    return out_->add_data(plan);
  }

  void make_frames() {
    amber_["coordinates"] = vectors(layout_->position, atom_, unit("m", "meter"));
    amber_["velocities"] = vectors(layout_->velocity, atom_, unit("m s-1", "meter/second"));
    if (facts_->grains_rotate)
      amber_["spin"] = of_frames(layout_->spin, {.element = Hdf5Element::real32,
                                                 .extent = {frames_, facts_->grains},
                                                 .attributes = unit("rad s-1", "radian/second"),
                                                 .scales = {frame_, atom_}});
    amber_["cell_lengths"] = of_frames(layout_->cell, {.element = Hdf5Element::real32,
                                                       .extent = {frames_, all},
                                                       .attributes = unit("m", "meter"),
                                                       .scales = {frame_, cell_}});
    amber_["cell_angles"] = out_->add_data({.element = Hdf5Element::real32,
                                            .extent = {frames_, all},
                                            .rows_per_chunk = layout_->frames_per_block,
                                            .fill = 90.0,
                                            .attributes = Hdf5Attributes().add("units", "degree"),
                                            .scales = {frame_, angle_}});
    amber_["time"] = of_frames(layout_->time, {.element = Hdf5Element::real64,
                                               .extent = {frames_},
                                               .attributes = unit("s", "second"),
                                               .scales = {frame_}});
    step_ = of_frames(layout_->step,
                      {.element = Hdf5Element::int64, .extent = {frames_}, .scales = {frame_}});
    amber_["radius"] = fixed(Hdf5Element::real64, fixed_->radius, unit("m", "meter"), atom_);
    amber_["mass"] = fixed(Hdf5Element::real64, fixed_->mass, unit("kg", "kilogram"), atom_);
  }

  std::uint64_t count_of(const Hdf5Scale& scale) const {
    return scale.index == atom_.index ? facts_->grains : facts_->wall_grains;
  }

  /// The vectors of all grains or of all wall grains.
  std::uint64_t vectors(std::uint64_t offset, const Hdf5Scale& scale,
                        const Hdf5Attributes& attributes) {
    return of_frames(offset, {.element = Hdf5Element::real32,
                              .extent = {frames_, count_of(scale), all},
                              .attributes = attributes,
                              .scales = {frame_, scale, spatial_}});
  }

  std::uint64_t fixed(Hdf5Element element, std::uint64_t piece, const Hdf5Attributes& attributes,
                      const Hdf5Scale& scale) {
    return out_->add_data({.element = element,
                           .extent = {count_of(scale)},
                           .piece = piece,
                           .attributes = attributes,
                           .scales = {scale}});
  }

  std::uint64_t h5md() {
    const auto author = out_->add_group({}, Hdf5Attributes().add("name", "riesel"));
    const auto creator = out_->add_group(
        {}, Hdf5Attributes().add("name", "riesel").add("version", build_info().version));
    const auto units =
        out_->add_group({}, Hdf5Attributes().add("version", {1, 0}).add("system", "SI"));
    return out_->add_group({{"author", author},
                            {"creator", creator},
                            {"modules", out_->add_group({{"units", units}})}},
                           Hdf5Attributes().add("version", {1, 1}));
  }

  /// What made the run: its settings and the commit.
  std::uint64_t parameters() {
    return out_->add_group(
        {},
        Hdf5Attributes().add("settings", facts_->settings).add("commit", build_info().git_commit));
  }

  std::uint64_t box() {
    const std::array<double, all> edges = {facts_->width, facts_->length, facts_->largest_diameter};
    const auto data = out_->add_data({.extent = {all},
                                      .piece = out_->add_elements(bytes_of(edges)),
                                      .attributes = Hdf5Attributes().add("unit", "m")});
    return out_->add_group({{"edges", data}}, Hdf5Attributes()
                                                  .add("dimension", std::int64_t{all})
                                                  .add("boundary", {"none", "periodic", "none"}));
  }

  std::uint64_t particles() {
    const auto space = box();
    Members grains = {{"box", space},
                      {"position", in_time(amber_["coordinates"])},
                      {"velocity", in_time(amber_["velocities"])},
                      {"radius", amber_["radius"]},
                      {"mass", amber_["mass"]},
                      {"id", fixed(Hdf5Element::int32, fixed_->id, {}, atom_)}};
    if (facts_->grains_rotate) grains["spin"] = in_time(amber_["spin"]);
    const auto walls =
        out_->add_group({{"box", space},
                         {"position", wall_position()},
                         {"radius", fixed(Hdf5Element::real64, fixed_->wall_radius,
                                          unit("m", "meter"), wall_grain_)},
                         {"id", fixed(Hdf5Element::int32, fixed_->wall_id, {}, wall_grain_)}});
    return out_->add_group({{"grains", out_->add_group(grains)}, {"walls", walls}});
  }

  /// An element of H5MD that depends on time.
  std::uint64_t in_time(std::uint64_t value) {
    return out_->add_group({{"step", step_}, {"time", amber_["time"]}, {"value", value}});
  }

  std::uint64_t wall_position() {
    if (facts_->walls_move)
      return in_time(vectors(layout_->wall_position, wall_grain_, unit("m", "meter")));
    return out_->add_data({.element = Hdf5Element::real32,
                           .extent = {facts_->wall_grains, all},
                           .piece = fixed_->wall_position,
                           .attributes = unit("m", "meter"),
                           .scales = {wall_grain_, spatial_}});
  }

  Hdf5Outline* out_;
  const TrajectoryFacts* facts_;
  const FixedArrays* fixed_;
  const FrameBlocks* layout_;
  const std::vector<std::uint64_t>* blocks_;
  std::uint64_t frames_;
  Members amber_;  // the members of the root group
  Hdf5Scale frame_{}, atom_{}, wall_grain_{}, spatial_{}, cell_{}, angle_{};
  std::uint64_t step_ = 0;
};

}  // namespace

FrameBlocks::FrameBlocks(const TrajectoryFacts& facts, std::uint64_t frames)
    : frames_per_block(frames) {
  const std::uint64_t real32 = size_of(Hdf5Element::real32), eight = 8;
  std::uint64_t end = 0;
  const auto take = [&](std::uint64_t bytes_per_frame) {
    const auto begin = end;
    end += padded_to_8(frames * bytes_per_frame);
    return begin;
  };
  position = take(facts.grains * all * real32);
  velocity = take(facts.grains * all * real32);
  spin = take(facts.grains_rotate ? facts.grains * real32 : 0);
  wall_position = take(facts.walls_move ? facts.wall_grains * all * real32 : 0);
  cell = take(all * real32);
  step = take(eight);
  time = take(eight);
  size = end;
}

std::uint64_t outline_trajectory(Hdf5Outline& outline, const TrajectoryFacts& facts,
                                 const FixedArrays& fixed, const FrameBlocks& layout,
                                 const std::vector<std::uint64_t>& blocks, std::uint64_t frames) {
  return Tree(outline, facts, fixed, layout, blocks, frames).build();
}

}  // namespace riesel::io
