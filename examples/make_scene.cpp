// SPDX-License-Identifier: BSL-1.0
// Writes the scenes of examples/scenes: grains on a loose lattice, about to fall.
//
//   make_scene [FOLDER]      writes the four files into FOLDER (default: here)
//
// The same files come out every time: seeds are fixed, and nine digits do not show the last of the
// C library's cosines.
#include <talus/io/scene_file.hpp>
#include <talus/sample/granulometry.hpp>
#include <talus/sample/random_polygon.hpp>
#include <talus/sample/random_polyhedron.hpp>
#include <talus/sample/random_scene.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) try {
    const std::filesystem::path folder = argc > 1 ? argv[1] : ".";
    const auto write = [&](const char* name, const auto& scene) {
        write_scene(folder / name, scene, 9);
        std::printf("%s: %zu grains\n", (folder / name).string().c_str(), scene.grains.size());
    };
    const talus::UniformRadii even(0.004, 0.006);
    const talus::PowerLawRadii wide(0.003, 0.009, 2.0);
    write("discs.txt",
          talus::random_scene<2>({.grain_count = 300, .width = 0.20, .seed = 1}, even));
    write("polygons.txt", talus::random_scene<2>({.grain_count = 240, .width = 0.22, .seed = 2},
                                                 wide, [](talus::Random& random, double r) {
                                                     return talus::random_polygon(random, r);
                                                 }));
    write("spheres.txt",
          talus::random_scene<3>({.grain_count = 300, .width = 0.06, .seed = 3}, even));
    write("polyhedra.txt", talus::random_scene<3>({.grain_count = 60, .width = 0.045, .seed = 4},
                                                  even, [](talus::Random& random, double r) {
                                                      return talus::random_polyhedron(random, r);
                                                  }));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "make_scene: %s\n", error.what());
    return 1;
}
