#include "io/trajectory_file.hpp"

#include "io/byte_writer.hpp"
#include "io/descriptor.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/hdf5_handle.hpp"
#include "io/trajectory_head.hpp"
#include "io/trajectory_index.hpp"
#include "io/trajectory_outline.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace riesel::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t components = trajectory_components;

/// HDF5 reads a chunk as a whole: half of the megabyte that it keeps in memory.
constexpr std::uint64_t bytes_of_a_chunk = 524288;
/// Keeps the file of a short trajectory of few grains small.
constexpr std::uint64_t most_frames_in_a_block = 64;
/// HDF5 counts the bytes of a chunk in 32 bits.
constexpr std::uint64_t most_grains = UINT32_MAX / (components * sizeof(float));

/// The number of vectors in the largest array of a frame.
std::uint64_t most_places(const TrajectoryFacts& facts) {
  return std::max(facts.grains, facts.walls_move ? facts.wall_grains : 0);
}

std::uint64_t frames_in_a_block(const TrajectoryFacts& facts) {
  const auto size = std::max<std::uint64_t>(most_places(facts), 1) * components * sizeof(float);
  return std::clamp<std::uint64_t>(bytes_of_a_chunk / size, 1, most_frames_in_a_block);
}

TrajectoryFacts facts_of(const State& state, const std::string& settings) {
  std::uint64_t wall_grains = 0;
  bool walls_move = false;
  for (const auto& wall : state.walls) {
    wall_grains += static_cast<std::uint64_t>(wall.count);
    walls_move = walls_move || wall.motion.is_ever_away();
  }
  const auto& radii = state.grains.radius;
  return {.grains = state.grains.size(),
          .wall_grains = wall_grains,
          .walls_move = walls_move && wall_grains > 0,
          .grains_rotate = state.grains.rotate(),
          .width = state.box.width,
          .length = state.box.length,
          .largest_diameter = radii.empty() ? 0.0 : 2.0 * *std::ranges::max_element(radii),
          .settings = settings};
}

/// Below the end of the period, which rounding to float must not reach.
float place_y(const Box& box, double y) {
  return std::min(static_cast<float>(y), std::nextafter(static_cast<float>(box.length), 0.0F));
}

/// x, y, 0 of all wall grains where they are now.
std::vector<float> places_of_walls(const State& state) {
  std::vector<float> places;
  for (const auto& wall : state.walls) {
    const WallWay way = wall.motion.way(state.box, state.time());
    for (std::int64_t k = 0; k < wall.count; ++k) {
      const WallLattice::Place place = wall.place(k, way, state.box);
      places.insert(places.end(), {static_cast<float>(place.x), place_y(state.box, place.y), 0.0F});
    }
  }
  return places;
}

/// The arrays that belong to no frame, one after the other behind the head.
struct FixedPart {
  FixedArrays places;
  std::string bytes;
};

FixedPart fixed_part_of(const State& state, const TrajectoryFacts& facts) {
  std::vector<double> radius, mass, wall_radius;
  for (const auto slot : slots_by_id(state.grains)) {
    radius.push_back(state.grains.radius[slot]);
    mass.push_back(state.grains.mass[slot]);
  }
  for (const auto& wall : state.walls)
    wall_radius.insert(wall_radius.end(), static_cast<std::size_t>(wall.count), wall.radius);
  std::vector<std::int32_t> id(radius.size()), wall_id(wall_radius.size());
  std::iota(id.begin(), id.end(), 0);
  std::iota(wall_id.begin(), wall_id.end(), 0);

  ByteWriter bytes;
  const auto end = [&] { return trajectory_head_size + bytes.bytes().size(); };
  const auto put = [&](const auto& values) {
    const auto place = end();
    bytes.text(bytes_of(values)).align();
    return place;
  };
  const FixedArrays places = {
      // in the order of the file
      .radius = put(radius),
      .mass = put(mass),
      .id = put(id),
      .wall_position = put(facts.walls_move ? std::vector<float>() : places_of_walls(state)),
      .wall_radius = put(wall_radius),
      .wall_id = put(wall_id),
      .wall_end = end()};
  return {.places = places, .bytes = bytes.bytes()};
}

/// One frame: grains in the order of their ids, in SI units.
struct Frame {
  std::vector<float> position, velocity;  // x, y, 0
  std::vector<float> spin;                // 0 where they do not rotate

  explicit Frame(const State& state)
      : position(components * state.grains.size()),
        velocity(position.size()),
        spin(state.grains.size()) {
    const GrainView grains(state);
    for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
      const Grain grain = grains[slot];
      const auto id = static_cast<std::size_t>(state.grains.id[slot]);
      const auto i = components * id;
      position[i] = static_cast<float>(grain.x);
      position[i + 1] = place_y(state.box, grain.y);
      velocity[i] = static_cast<float>(grain.vx);
      velocity[i + 1] = static_cast<float>(grain.vy);
      spin[id] = static_cast<float>(grain.spin);
    }
  }
};

/// `interval`: s, between two frames.
std::string index_of(const fs::path& trajectory, const TrajectoryFacts& facts, std::uint64_t frames,
                     double interval) {
  return trajectory_index({.file = trajectory.filename().string(),
                           .grains = facts.grains,
                           .wall_grains = facts.wall_grains,
                           .frames = frames,
                           .walls_move = facts.walls_move,
                           .grains_rotate = facts.grains_rotate,
                           .interval = interval});
}

}  // namespace

class TrajectoryFile::Contents {
public:
  /// A new file.
  Contents(fs::path path, std::uint64_t run, const State& state, std::int64_t steps_per_frame,
           const std::string& settings)
      : Contents(std::move(path), facts_of(state, settings), state.time_step) {
    head_.run = run;
    head_.steps_per_frame = static_cast<std::uint64_t>(steps_per_frame);
    head_.frames_per_block = layout_.frames_per_block;
    const FixedPart fixed = fixed_part_of(state, facts_);
    fixed_ = fixed.places;
    head_.end = fixed_.wall_end;
    auto [root, outline] = next_outline();
    std::string content = written(head_, root) + fixed.bytes + outline;
    content.resize(head_.end, '\0');
    write_durably(path_, content);
    write_index();
    file_.emplace(path_, O_RDWR, path_);
  }

  /// A file that is there.
  Contents(fs::path path, const State& state, const std::string& settings)
      : Contents(std::move(path), facts_of(state, settings), state.time_step) {
    file_.emplace(path_, O_RDWR | O_NOFOLLOW, path_);
    const std::string head = file_->read_at(0, trajectory_head_size);
    head_ = read_trajectory_head(Bytes(head));
    require(head_.grains == facts_.grains && head_.wall_grains == facts_.wall_grains
                && head_.frames_per_block == layout_.frames_per_block,
            "it was written for other grains");
    require(head_.end <= file_->size(), "it is shorter than its head says");
    fixed_ = fixed_part_of(state, facts_).places;
    read_blocks();
  }

  std::uint64_t run() const { return head_.run; }
  std::uint64_t steps_per_frame() const { return head_.steps_per_frame; }
  std::uint64_t frames() const { return head_.frames; }

  void cut(std::uint64_t frames) { head_.frames = frames; }

  /// Copies the file if it has other names: a copy of the run that was made of hard links (cp -al,
  /// rsnapshot) is to keep its frames, and this file grows in place.
  void leave_other_names() {
    if (!file_->has_other_names()) return;
    replace_by_copy(path_);
    file_.emplace(path_, O_RDWR | O_NOFOLLOW, path_);
  }

  void append(const State& state) {
    const Frame frame(state);
    const std::uint64_t in_block = head_.frames % layout_.frames_per_block;
    const std::uint64_t block = block_of(head_.frames / layout_.frames_per_block);
    const auto write = [&](std::uint64_t offset, std::string_view bytes) {
      file_->write_at(block + offset + in_block * bytes.size(), bytes);
    };
    const std::array<float, components> cell = {0.0F, static_cast<float>(facts_.length), 0.0F};
    const std::array<std::int64_t, 1> step = {state.step};
    const std::array<double, 1> time = {state.time()};
    write(layout_.position, bytes_of(frame.position));
    write(layout_.velocity, bytes_of(frame.velocity));
    if (facts_.grains_rotate) write(layout_.spin, bytes_of(frame.spin));
    if (facts_.walls_move) write(layout_.wall_position, bytes_of(places_of_walls(state)));
    write(layout_.cell, bytes_of(cell));
    write(layout_.step, bytes_of(step));
    write(layout_.time, bytes_of(time));
    ++head_.frames;
  }

  void commit() {
    // After a failed commit the disk may point to either outline, and the next one might be written
    // over the one in use.
    if (std::exchange(is_committing_, true))
      throw std::logic_error("a commit of the trajectory has failed before");
    const auto [root, outline] = next_outline();
    file_->make_at_least(head_.end);
    file_->sync();
    file_->write_at(head_.places.at(head_.in_use).address, outline);
    file_->sync();
    file_->write_at(0, written(head_, root));
    file_->sync();
    write_index();
    is_committing_ = false;
  }

private:
  Contents(fs::path path, TrajectoryFacts facts, double time_step)
      : path_(std::move(path)),
        facts_(std::move(facts)),
        time_step_(time_step),
        layout_(facts_, frames_in_a_block(facts_)) {
    head_.grains = facts_.grains;
    head_.wall_grains = facts_.wall_grains;
  }

  /// The address of a block; a new one is placed at the end of the file.
  std::uint64_t block_of(std::uint64_t number) {
    if (number == blocks_.size())
      blocks_.push_back(std::exchange(head_.end, head_.end + layout_.size));
    return blocks_.at(number);
  }

  struct Outline {
    std::uint64_t root;
    std::string bytes;  // addresses of blocks, then what HDF5 reads
  };

  Outline outline_at(std::uint64_t address) const {
    ByteWriter blocks;
    for (const auto block : blocks_) blocks.number(block, 8);
    Hdf5Outline outline(address + blocks.bytes().size());
    try {
      const auto root = outline_trajectory(outline, facts_, fixed_, layout_, blocks_, head_.frames);
      return {.root = root, .bytes = blocks.bytes() + outline.bytes()};
    } catch (const Hdf5Error& error) {  // only the settings can be too long
      throw FileError(path_, fmt::format("cannot hold the settings ({})", error.what()),
                      "shorten them, or run without a trajectory");
    }
  }

  /// The outline for the place that is not in use, which from now on counts in the head as the one
  /// in use.
  Outline next_outline() {
    head_.in_use = 1 - head_.in_use;
    OutlinePlace& place = head_.places.at(head_.in_use);
    Outline outline = outline_at(place.address);
    if (outline.bytes.size() > place.capacity) {
      place = {.address = head_.end, .capacity = 2 * outline.bytes.size()};
      head_.end += place.capacity;
      outline = outline_at(place.address);
    }
    head_.blocks = blocks_.size();
    head_.outline_size = outline.bytes.size();
    head_.outline_checksum = checksum_of(outline.bytes);
    return outline;
  }

  void read_blocks() {
    const OutlinePlace& place = head_.places.at(head_.in_use);
    require(head_.outline_size <= place.capacity && place.capacity <= head_.end
                && place.address <= file_->size()
                && head_.outline_size <= file_->size() - place.address
                && head_.blocks <= head_.outline_size / 8,
            "its head is damaged");
    const std::string outline = file_->read_at(place.address, head_.outline_size);
    require(checksums_are_forged || checksum_of(outline) == head_.outline_checksum,
            "its outline is damaged");
    for (std::uint64_t i = 0; i < head_.blocks; ++i) {
      blocks_.push_back(Bytes(outline).number(8 * i, 8));
      require(blocks_[i] >= fixed_.wall_end && blocks_[i] <= head_.end
                  && layout_.size <= head_.end - blocks_[i],
              "its outline is damaged");
    }
    require(head_.frames <= head_.blocks * layout_.frames_per_block, "its outline is damaged");
  }

  void write_index() const {
    const double interval = static_cast<double>(head_.steps_per_frame) * time_step_;
    write_durably(fs::path(path_).replace_filename(trajectory_index_name),
                  index_of(path_, facts_, head_.frames, interval));
  }

  fs::path path_;
  TrajectoryFacts facts_;
  double time_step_;  // s
  FixedArrays fixed_{};
  FrameBlocks layout_;
  TrajectoryHead head_;
  std::vector<std::uint64_t> blocks_;  // addresses
  std::optional<Descriptor> file_;
  bool is_committing_ = false;  // stays true if that has failed
};

TrajectoryFile::TrajectoryFile(std::unique_ptr<Contents> contents)
    : contents_(std::move(contents)) {}
TrajectoryFile::~TrajectoryFile() = default;
TrajectoryFile::TrajectoryFile(TrajectoryFile&&) noexcept = default;
TrajectoryFile& TrajectoryFile::operator=(TrajectoryFile&&) noexcept = default;

TrajectoryFile TrajectoryFile::create(const fs::path& path, std::uint64_t run, const State& state,
                                      std::int64_t steps_per_frame, const std::string& settings) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(path, ignored)))
    throw FileError(path, "exists already", "choose another directory, or remove it");
  if (most_places(facts_of(state, {})) > most_grains)
    throw FileError(path, fmt::format("cannot hold frames of more than {} grains", most_grains),
                    "run without a trajectory");
  return TrajectoryFile(std::make_unique<Contents>(path, run, state, steps_per_frame, settings));
}

TrajectoryFile TrajectoryFile::reopen(const fs::path& path, std::uint64_t run, const State& state,
                                      std::int64_t steps_per_frame, const std::string& settings) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw FileError(path, "is missing", "restore the file, or start the run again elsewhere");
  const auto wanted = static_cast<std::uint64_t>(state.step / steps_per_frame + 1);
  const auto misfit = [&](const std::exception& flaw) {
    return FileError(path, fmt::format("does not fit the checkpoint ({})", flaw.what()),
                     "restore the file that belongs to it, or start the run again");
  };
  try {
    auto contents = std::make_unique<Contents>(path, state, settings);
    require(contents->run() == run, "it belongs to another run");
    require(contents->steps_per_frame() == static_cast<std::uint64_t>(steps_per_frame),
            "its frames are at another interval");
    require(
        contents->frames() >= wanted,
        fmt::format("it has {} frames, but the checkpoint expects {}", contents->frames(), wanted));
    contents->cut(wanted);
    contents->leave_other_names();
    return TrajectoryFile(std::move(contents));
  } catch (const Hdf5Error& flaw) {
    throw misfit(flaw);
  } catch (const OutOfBytes& flaw) {
    throw misfit(flaw);
  }
}

void TrajectoryFile::append(const State& state) { contents_->append(state); }
std::int64_t TrajectoryFile::frames() const {
  return static_cast<std::int64_t>(contents_->frames());
}
void TrajectoryFile::commit() { contents_->commit(); }

FrameSize size_of_frame(const State& state) {
  const TrajectoryFacts facts = facts_of(state, {});
  const auto index = [&](std::uint64_t frames) {
    return index_of(trajectory_name, facts, frames, 1.0).size();
  };
  return {.file = FrameBlocks(facts, 1).size, .index = index(2) - index(1)};
}

}  // namespace riesel::io
