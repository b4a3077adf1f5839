// Rows of files are made by all threads, a few chunks at a time, and written in their order.
#include "vpm/job/photon_files.h"

#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <span>

#include "vpm/base/atomic_file.h"
#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/base/parallel.h"

namespace vpm {
namespace {

bool is_ply(const std::filesystem::path& path) { return path.extension() == ".ply"; }

/// A file under way, of which nothing is left where it is not committed.
class RowFile {
 public:
  explicit RowFile(const std::filesystem::path& path)
      : target_(path), temporary_(path), file_(std::fopen(temporary_.path().c_str(), "wb"), &std::fclose) {
    if (!file_) fail();
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // chunks are large
  }

  void write(const std::string& bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail();
  }
  /// Writes rows 0 to `count` - 1, which append(row, text) makes.
  void write_rows(size_t count, size_t bytes_of_row, const std::function<void(size_t, std::string&)>& append) {
    constexpr size_t kChunk = 1 << 14;
    const size_t wave = kChunk * 4 * static_cast<size_t>(thread_count());
    for (size_t begin = 0; begin < count; begin += wave) {
      std::vector<std::string> chunks(chunk_count(std::min(wave, count - begin), kChunk));
      parallel_for_chunks(std::min(wave, count - begin), kChunk, [&](size_t from, size_t to, size_t chunk) {
        cancellation_point();
        chunks[chunk].reserve(kChunk * bytes_of_row);
        for (size_t row = begin + from; row < begin + to; ++row) append(row, chunks[chunk]);
      });
      for (const std::string& chunk : chunks) write(chunk);
    }
  }
  void commit() {
    if (std::fflush(file_.get()) != 0) fail();
    file_.reset();
    temporary_.commit();
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(fmt::format("{}: cannot write: {}", target_.string(), std::strerror(errno)));
  }

  std::filesystem::path target_;
  TemporaryFile temporary_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

/// The colour that viewers show: the hue of a power at full brightness.
void append_colour(std::string& bytes, const Rgb& power) {
  const float most = max_channel(power);
  for (int c = 0; c < 3; ++c)
    bytes += static_cast<char>(most > 0.0f ? static_cast<int>(255.0f * power[c] / most + 0.5f) : 0);
}

uint32_t number_in_ply(uint64_t number) {
  if (number > 0xffffffffu)
    throw InputError(fmt::format("photon number {} is too large for a .ply file; write .csv", number));
  return static_cast<uint32_t>(number);
}

/// A comment for each number that stands for a name, which has no line breaks there.
std::string comments(const char* what, std::span<const std::string> names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    std::string name = names[i];
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    text += fmt::format("comment {} {} {}\n", what, i, name);
  }
  return text;
}

std::string header_of_ply(const std::string& about, std::span<const std::string> places, size_t vertices,
                          std::initializer_list<std::pair<const char*, const char*>> properties) {
  std::string text = fmt::format("ply\nformat binary_little_endian 1.0\ncomment {}\n{}{}element vertex {}\n", about,
                                 comments("place", places), comments("event", names_of_photon_events()), vertices);
  for (const auto& [type, names] : properties) {
    std::string_view rest = names;
    while (!rest.empty()) {
      const size_t end = std::min(rest.find(' '), rest.size());
      text += fmt::format("property {} {}\n", type, rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
  return text;
}

/// Names of a scene as fields of a table.
std::vector<std::string> quoted(std::span<const std::string> names) {
  std::vector<std::string> fields;
  for (const std::string& name : names) {
    std::string field = name;
    if (name.find_first_of(",\"\n\r") != std::string::npos) {
      field = "\"";
      for (const char c : name) field += c == '"' ? std::string("\"\"") : std::string(1, c);
      field += '"';
    }
    fields.push_back(field);
  }
  return fields;
}

void write_photons_ply(const StoredPhotons& stored, RowFile& file) {
  const std::string about =
      fmt::format("photons of vpm: x, y, z in m, nx, ny, nz the direction of travel, power in W, {} emitted\n{}",
                  stored.emitted, comments("map", stored.maps));
  file.write(header_of_ply(about.substr(0, about.size() - 1), stored.places, stored.photons.size(),
                           {{"float", "x y z nx ny nz power_r power_g power_b density"},
                            {"uint", "number place"},
                            {"ushort", "scatterings reflections"},
                            {"uchar", "map event red green blue"}}) +
             "end_header\n");
  file.write_rows(stored.photons.size(), 64, [&](size_t i, std::string& bytes) {
    const StoredPhoton& p = stored.photons[i];
    static_assert(offsetof(StoredPhoton, number) == 10 * sizeof(float));
    static_assert(offsetof(StoredPhoton, event) == offsetof(StoredPhoton, place) + 9);
    bytes.append(reinterpret_cast<const char*>(&p), offsetof(StoredPhoton, number));
    append_bytes(bytes, number_in_ply(p.number));
    bytes.append(reinterpret_cast<const char*>(&p.place), 10);  // up to the event
    append_colour(bytes, p.power);
  });
}

void write_photons_csv(const StoredPhotons& stored, RowFile& file) {
  const std::vector<std::string> places = quoted(stored.places), events = names_of_photon_events();
  file.write(
      "x,y,z,direction_x,direction_y,direction_z,power_r,power_g,power_b,density,number,place,scatterings,reflections,"
      "map,event\n");
  file.write_rows(stored.photons.size(), 160, [&](size_t i, std::string& text) {
    const StoredPhoton& p = stored.photons[i];
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", p.position.x,
                   p.position.y, p.position.z, p.direction.x, p.direction.y, p.direction.z, p.power.r, p.power.g,
                   p.power.b, p.density, p.number, places[p.place], p.scatterings, p.reflections, stored.maps[p.map],
                   events[static_cast<size_t>(p.event)]);
  });
}

/// Does a flight go on from where the one before it ended?
bool follows(const PhotonFlights& all, size_t i) {
  return i > 0 && all.flights[i].number == all.flights[i - 1].number && all.flights[i].from == all.flights[i - 1].to;
}

void append_vertex(std::string& bytes, const PhotonFlight& flight, const Vec3& position, PhotonEvent event) {
  append_bytes(bytes, position);
  append_bytes(bytes, flight.power);
  append_bytes(bytes, number_in_ply(flight.number));
  append_bytes(bytes, event == PhotonEvent::departure ? kNoPlace : flight.place);
  append_bytes(bytes, flight.scatterings);
  append_bytes(bytes, flight.reflections);
  append_bytes(bytes, event);
  append_colour(bytes, flight.power);
}

void write_flights_ply(const PhotonFlights& all, RowFile& file) {
  std::vector<uint32_t> ends;  // the vertex of each flight's end
  uint32_t vertices = 0;
  if (all.flights.size() > 0x3fffffff)
    throw InputError("there are too many flights for the numbers of vertices in a .ply file; write .csv");
  for (size_t i = 0; i < all.flights.size(); ++i) {
    vertices += follows(all, i) ? 1 : 2;
    ends.push_back(vertices - 1);
  }
  file.write(
      header_of_ply(
          fmt::format("paths of photons of vpm: x, y, z in m, power in W on arrival, {} emitted", all.emitted),
          all.places, vertices,
          {{"float", "x y z power_r power_g power_b"},
           {"uint", "number place"},
           {"ushort", "scatterings reflections"},
           {"uchar", "event red green blue"}}) +
      fmt::format("element edge {}\nproperty int vertex1\nproperty int vertex2\nend_header\n", all.flights.size()));
  file.write_rows(all.flights.size(), 80, [&](size_t i, std::string& bytes) {
    const PhotonFlight& flight = all.flights[i];
    if (!follows(all, i)) append_vertex(bytes, flight, flight.from, PhotonEvent::departure);
    append_vertex(bytes, flight, flight.to, flight.event);
  });
  file.write_rows(all.flights.size(), 8, [&](size_t i, std::string& bytes) {
    append_bytes(bytes, ends[i] - 1);
    append_bytes(bytes, ends[i]);
  });
}

void write_flights_csv(const PhotonFlights& all, RowFile& file) {
  const std::vector<std::string> places = quoted(all.places), events = names_of_photon_events();
  file.write(
      "from_x,from_y,from_z,to_x,to_y,to_z,power_r,power_g,power_b,number,place,scatterings,reflections,event\n");
  file.write_rows(all.flights.size(), 160, [&](size_t i, std::string& text) {
    const PhotonFlight& f = all.flights[i];
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", f.from.x, f.from.y,
                   f.from.z, f.to.x, f.to.y, f.to.z, f.power.r, f.power.g, f.power.b, f.number,
                   f.place == kNoPlace ? "" : places[f.place], f.scatterings, f.reflections,
                   events[static_cast<size_t>(f.event)]);
  });
}

}  // namespace

void check_photon_file(const std::filesystem::path& path) {
  if (!is_ply(path) && path.extension() != ".csv")
    throw InputError(fmt::format("{}: photons are written as .ply or .csv", path.string()));
  check_writable(path, 0);
}

void write_photons(const StoredPhotons& photons, const std::filesystem::path& path) {
  check_photon_file(path);
  RowFile file(path);
  is_ply(path) ? write_photons_ply(photons, file) : write_photons_csv(photons, file);
  file.commit();
}

void write_flights(const PhotonFlights& flights, const std::filesystem::path& path) {
  check_photon_file(path);
  RowFile file(path);
  is_ply(path) ? write_flights_ply(flights, file) : write_flights_csv(flights, file);
  file.commit();
}

}  // namespace vpm
