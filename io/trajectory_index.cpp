#include "io/trajectory_index.hpp"

#include <fmt/format.h>

#include <string_view>

namespace riesel::io {
namespace {

/// A whole array of the file; `precision`: bytes of a number.
std::string whole(std::string_view file, std::string_view path, const std::string& extent,
                  int precision) {
  return fmt::format(
      R"(<DataItem Dimensions="{}" NumberType="Float" Precision="{}" Format="HDF">{}:{}</DataItem>)",
      extent, precision, file, path);
}

/// One frame of an array with `count` vectors per frame.
std::string of_frame(const TrajectoryIndex& index, std::string_view path, std::uint64_t count,
                     std::uint64_t frame) {
  return fmt::format(
      R"(<DataItem ItemType="HyperSlab" Dimensions="{0} 3" Type="HyperSlab">)"
      R"(<DataItem Dimensions="3 3" Format="XML">{1} 0 0 1 1 1 1 {0} 3</DataItem>{2}</DataItem>)",
      count, frame, whole(index.file, path, fmt::format("{} {} 3", index.frames, count), 4));
}

/// One frame of an array with one number per grain.
std::string numbers_of_frame(const TrajectoryIndex& index, std::string_view path,
                             std::uint64_t frame) {
  return fmt::format(
      R"(<DataItem ItemType="HyperSlab" Dimensions="{0}" Type="HyperSlab">)"
      R"(<DataItem Dimensions="3 2" Format="XML">{1} 0 1 1 1 {0}</DataItem>{2}</DataItem>)",
      index.grains, frame,
      whole(index.file, path, fmt::format("{} {}", index.frames, index.grains), 4));
}

std::string points(std::uint64_t count, const std::string& places) {
  return fmt::format(R"(<Topology TopologyType="Polyvertex" NumberOfElements="{}"/>)"
                     R"(<Geometry GeometryType="XYZ">{}</Geometry>)",
                     count, places);
}

std::string attribute(std::string_view name, std::string_view type, const std::string& values) {
  return fmt::format(R"(<Attribute Name="{}" AttributeType="{}" Center="Node">{}</Attribute>)",
                     name, type, values);
}

std::string radius(const TrajectoryIndex& index, std::string_view group, std::uint64_t count) {
  return attribute(
      "radius", "Scalar",
      whole(index.file, fmt::format("/particles/{}/radius", group), fmt::format("{}", count), 8));
}

std::string grid(std::string_view name, const std::string& content) {
  return fmt::format(R"(<Grid Name="{}" GridType="Uniform">{}</Grid>)"
                     "\n",
                     name, content);
}

}  // namespace

std::string trajectory_index(const TrajectoryIndex& index) {
  const auto walls = [&](std::uint64_t frame) {
    if (index.wall_grains == 0) return std::string();  // ParaView reads no grid without points
    const std::string places = index.walls_move ? of_frame(index, "/particles/walls/position/value",
                                                           index.wall_grains, frame)
                                                : whole(index.file, "/particles/walls/position",
                                                        fmt::format("{} 3", index.wall_grains), 4);
    return grid("walls",
                points(index.wall_grains, places) + radius(index, "walls", index.wall_grains));
  };
  const auto spins = [&](std::uint64_t frame) {
    if (!index.grains_rotate) return std::string();
    return attribute("spin", "Scalar",
                     numbers_of_frame(index, "/particles/grains/spin/value", frame));
  };
  const std::string radii = radius(index, "grains", index.grains);
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\"><Domain>\n"
      "<Grid Name=\"trajectory\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::uint64_t frame = 0; frame < index.frames; ++frame) {
    text += fmt::format("<Grid Name=\"frame\" GridType=\"Collection\" CollectionType=\"Spatial\">"
                        "<Time Value=\"{}\"/>\n",
                        static_cast<double>(frame) * index.interval);
    text += grid("grains", points(index.grains, of_frame(index, "/particles/grains/position/value",
                                                         index.grains, frame))
                               + attribute("velocity", "Vector",
                                           of_frame(index, "/particles/grains/velocity/value",
                                                    index.grains, frame))
                               + spins(frame) + radii);
    text += walls(frame) + "</Grid>\n";
  }
  return text + "</Grid>\n</Domain></Xdmf>\n";
}

}  // namespace riesel::io
