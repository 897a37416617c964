#include "io/sealed_hdf5.hpp"

#include "io/seal.hpp"
#include "io/whole_file.hpp"

#include <utility>

namespace riesel::io {

void write_sealed_hdf5(const std::filesystem::path& path, Hdf5File& file, std::string_view kind,
                       Previous previous) {
  const auto image = file.image();
  seal(image, kind);
  write_durably(path, std::string_view(image.data(), image.size()), previous);
}

StoredGroup open_sealed_hdf5(const std::filesystem::path& path, std::string_view kind) {
  auto bytes = read_whole_file(path);
  if (const auto flaw = flaw_of_seal(bytes, kind); !flaw.empty()) throw Hdf5Error(flaw);
  return stored_hdf5(std::move(bytes), seal_size);
}

}  // namespace riesel::io
