// SPDX-License-Identifier: BSL-1.0
#include <talus/geometry/any_shape.hpp>
#include <talus/io/series/movie_series.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "common/dimensions.hpp"
#include "common/ellipsoid.hpp"
#include "temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(io_movie_series)

using talus::MovieSeries;
using talus::MovieWords;
using talus::Vector;

const MovieWords words{.title = "A \"pile\"", .scalar = "load", .unit = "N"};

template <int Dim>
using Shapes = std::vector<talus::AnyShape<Dim>>;

/// A floor and balls side by side, which move and turn as they please.
template <int Dim>
struct Scene {
    talus::Bodies<Dim> bodies;
    Shapes<Dim> shapes;

    explicit Scene(int balls) {
        bodies.add_obstacle({});
        shapes.emplace_back(talus::HalfSpace<Dim>(Vector<Dim>::Unit(Dim - 1)));
        for (int i = 0; i < balls; ++i) add_ball(i + 1.0);
    }
    void add_ball(double x) {
        bodies.add({1.0, talus::AngularVector<Dim>::Ones()}, {x * Vector<Dim>::Unit(0), {}});
        shapes.emplace_back(talus::Ball<Dim>(0.5));
    }
    void move_to(double time) {
        for (std::size_t i = 1; i < bodies.count(); ++i) {
            bodies.position[i][1] = time / 3.0;
            bodies.rotation[i] =
                talus::Rotation<Dim>::exp(time * talus::AngularVector<Dim>::Ones());
        }
    }
    std::vector<double> loads() const { return std::vector<double>(bodies.count(), 2.5); }
};

std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// The numbers of a list within a line.
std::vector<double> list_of(const std::string& line, const std::string& name) {
    const std::size_t at = line.find("\"" + name + "\":[");
    BOOST_REQUIRE(at != std::string::npos);
    std::vector<double> numbers;
    for (const char* c = line.c_str() + at + name.size() + 3; *c == ',' || *c == '[';) {
        if (c[1] == ']') break;
        char* end = nullptr;
        numbers.push_back(std::strtod(c + 1, &end));
        c = end;
    }
    return numbers;
}

std::string number(int x) { return std::to_string(x); }

BOOST_AUTO_TEST_CASE_TEMPLATE(a_movie_tells_shapes_once_and_poses_in_every_frame, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("movie");
    const auto path = folder / "run.movie";
    Scene<Dim> scene(2);
    MovieSeries<Dim> movie(path, words);
    const std::string header = R"({"format":"talus movie","version":1,"dimension":)" + number(Dim) +
                               R"(,"title":"A \"pile\"","scalar":"load","unit":"N"})";
    BOOST_TEST(content_of(path) == header + "\n");
    scene.move_to(0.1);
    movie.add(0.1, scene.bodies, scene.shapes, scene.loads());
    scene.move_to(0.2);
    scene.add_ball(7.0);
    movie.add(0.1 + 0.2, scene.bodies, scene.shapes, scene.loads());
    const auto lines = lines_of(path);
    BOOST_REQUIRE(lines.size() == 7u);
    const std::string up = Dim == 2 ? "0,1" : "0,0,1", zero = Dim == 2 ? "0,0" : "0,0,0";
    BOOST_TEST(lines[1] == R"({"body":0,"obstacle":true,"shape":{"kind":"half_space","normal":[)" +
                               up + R"(],"offset":0}})");
    const std::string ball =
        R"("obstacle":false,"shape":{"kind":"ball","radius":0.5,"centre":[)" + zero + "]}}";
    BOOST_TEST(lines[2] == R"({"body":1,)" + ball);
    BOOST_TEST(lines[3] == R"({"body":2,)" + ball);
    BOOST_TEST(lines[5] == R"({"body":3,)" + ball);
    // Times to the bit, poses short.
    BOOST_TEST(lines[4].starts_with(R"({"time":0.1,"bodies":[0,1,2],"positions":[)"));
    BOOST_TEST(lines[6].starts_with(R"({"time":0.30000000000000004,"bodies":[0,1,2,3],)"));
    BOOST_TEST(lines[6].ends_with(R"("scalars":[2.5,2.5,2.5,2.5]})"));
    BOOST_TEST(lines[6].find("0.0666667") != std::string::npos);
    const auto positions = list_of(lines[6], "positions"),
               rotations = list_of(lines[6], "rotations");
    BOOST_REQUIRE(positions.size() == 4u * Dim);
    BOOST_REQUIRE(rotations.size() == 4u * (Dim == 2 ? 1u : 4u));
    for (std::size_t i = 0; i < 4; ++i) {
        for (int k = 0; k < Dim; ++k)
            BOOST_TEST(std::abs(positions[Dim * i + static_cast<std::size_t>(k)] -
                                scene.bodies.position[i][k]) < 1e-6);
        // Read as they are told: an angle, or x, y, z, w.
        if constexpr (Dim == 2) {
            BOOST_TEST(std::abs(rotations[i] - scene.bodies.rotation[i].angle()) < 1e-6);
        } else {
            const double* q = &rotations[4 * i];
            const talus::Rotation<3> read(Eigen::Quaterniond(q[3], q[0], q[1], q[2]));
            BOOST_TEST(read.distance(scene.bodies.rotation[i]) < 1e-5);
        }
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_body_that_is_gone_is_in_no_later_frame, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("movie");
    Scene<Dim> scene(3);
    MovieSeries<Dim> movie(folder / "run.movie", {});
    movie.add(0.0, scene.bodies, scene.shapes);
    scene.bodies.keep_if([](std::size_t i) { return i != 1; });
    scene.shapes.erase(scene.shapes.begin() + 1);
    movie.add(1.0, scene.bodies, scene.shapes);
    const auto lines = lines_of(folder / "run.movie");
    BOOST_REQUIRE(lines.size() == 7u);
    BOOST_TEST(lines[6].starts_with(R"({"time":1,"bodies":[0,2,3],)"));
    BOOST_TEST(lines[6].find("scalars") == std::string::npos);
}

/// The JSON of a shape.
template <int Dim, class S>
std::string told(const S& shape) {
    std::string text;
    talus::detail::add_shape(text, talus::view_of<Dim>(shape));
    return text;
}

/// Nothing but a box, on one side without an end if told so.
template <int Dim>
struct Stranger {
    bool endless = false;
    talus::Aabb<Dim> aabb(const talus::Pose<Dim>&) const {
        talus::Aabb<Dim> box{-Vector<Dim>::Ones(), 2.0 * Vector<Dim>::Ones()};
        if (endless) box.high[0] = std::numeric_limits<double>::infinity();
        return box;
    }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(any_shape_is_told_by_what_it_is, D, dimensions) {
    constexpr int Dim = D::value;
    const bool plane = Dim == 2;
    const talus::Capsule<Dim> capsule(1.0, 0.25);
    BOOST_TEST(
        told<Dim>(capsule) ==
        (plane ? R"({"kind":"core","radius":0.25,"vertices":[-1,-0,1,0],"faces":[[0,1],[1,0]]})"
               : R"({"kind":"core","radius":0.25,"vertices":[-1,-0,-0,1,0,0],"faces":[]})"));
    const talus::Box<Dim> box(0.5 * Vector<Dim>::Ones());
    const std::string corners = told<Dim>(box);
    BOOST_TEST(list_of(corners, "vertices").size() == (plane ? 8u : 24u));
    BOOST_TEST(std::ranges::count(corners, '[') == (plane ? 6 : 8));
    const talus::AnyShape<Dim> any(box);
    BOOST_TEST(told<Dim>(any) == corners);
    const talus::Compound<Dim> pair(
        {{box, {}}, {talus::Ball<Dim>(0.1), {Vector<Dim>::Ones(), {}}}});
    BOOST_TEST(told<Dim>(pair) == R"({"kind":"compound","children":[)" + corners +
                                      R"(,{"kind":"ball","radius":0.1,"centre":[)" +
                                      (plane ? "1,1" : "1,1,1") + "]}]}");
    BOOST_TEST(told<Dim>(Stranger<Dim>{}) ==
               (plane ? R"({"kind":"box","low":[-1,-1],"high":[2,2]})"
                      : R"({"kind":"box","low":[-1,-1,-1],"high":[2,2,2]})"));
    BOOST_TEST(told<Dim>(Stranger<Dim>{true}) == R"({"kind":"unbounded"})");
}

BOOST_AUTO_TEST_CASE_TEMPLATE(an_own_convex_shape_is_told_by_points_all_around, D, dimensions) {
    constexpr int Dim = D::value;
    Vector<Dim> axes = 0.5 * Vector<Dim>::Ones();
    axes[0] = 2.0;
    const Ellipsoid<Dim> shape{axes};
    const auto numbers = list_of(told<Dim>(shape), "vertices");
    Vector<Dim> low = Vector<Dim>::Zero(), high = low;
    for (std::size_t i = 0; i < numbers.size(); i += Dim) {
        const auto p = Eigen::Map<const Vector<Dim>>(&numbers[i]);
        BOOST_TEST(std::abs(p.cwiseQuotient(axes).norm() - 1.0) < 1e-5);
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    BOOST_TEST((high - axes).norm() < 1e-5);
    BOOST_TEST((low + axes).norm() < 1e-5);
    // In a movie, in a list of that type alone.
    const TemporaryFolder folder("movie");
    Scene<Dim> scene(1);
    const std::vector shapes(2, shape);
    MovieSeries<Dim> movie(folder / "own.movie");
    movie.add(0.0, scene.bodies, shapes);
    BOOST_TEST(lines_of(folder / "own.movie").size() == 4u);
}

/// Every edge of a closed surface is met once each way, and the faces look outwards.
BOOST_AUTO_TEST_CASE(the_faces_of_points_all_around_close) {
    const talus::detail::Directions<3> around(24);
    std::vector<std::pair<std::size_t, std::size_t>> edges, back;
    double volume = 0.0;
    for (const auto& face : around.faces)
        for (std::size_t k = 0; k < face.size(); ++k) {
            edges.emplace_back(face[k], face[(k + 1) % face.size()]);
            back.emplace_back(face[(k + 1) % face.size()], face[k]);
            if (k > 1)
                volume +=
                    around.unit[face[0]].dot(around.unit[face[k - 1]].cross(around.unit[face[k]])) /
                    6.0;
        }
    std::ranges::sort(edges);
    std::ranges::sort(back);
    BOOST_TEST((edges == back));
    BOOST_TEST((std::ranges::adjacent_find(edges) == edges.end()));
    const double ball = 4.0 / 3.0 * std::numbers::pi;
    BOOST_TEST(volume < ball);
    BOOST_TEST(volume > 0.96 * ball);
}

template <int Dim>
void play(Scene<Dim>& scene, double from, double to, MovieSeries<Dim> movie) {
    for (double t = from; t <= to; t += 0.25) {
        scene.move_to(t);
        movie.add(t, scene.bodies, scene.shapes, scene.loads());
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_run_that_goes_on_appends, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("movie");
    const auto path = folder / "run.movie";
    Scene<Dim> scene(2);
    play(scene, 0.25, 1.0, MovieSeries<Dim>(path, words));
    // A body comes after 1 s, whose shape is told.
    Scene<Dim> grown(3);
    play(grown, 1.25, 2.0, MovieSeries<Dim>::resumed(path, words, 1.0));
    const std::string whole = content_of(path);
    BOOST_TEST(lines_of(path).size() == 1u + 4u + 8u);
    // Killed in the middle of a line, after more than the last checkpoint knows; before that body
    // came, so that it is told again, and after.
    for (const double time : {1.0, 1.1, 1.25, 1.75}) {
        std::ofstream(path, std::ios::app) << "{\"time\":2.25,\"bodies\":[0,1,";
        const double next = 0.25 * (std::floor(time / 0.25) + 1.0);
        play(grown, next, 2.0, MovieSeries<Dim>::resumed(path, words, time));
        BOOST_TEST(content_of(path) == whole);
    }
    // From the beginning, of nothing, and of a first line that was never whole.
    play(scene, 0.25, 1.0, MovieSeries<Dim>::resumed(path, words, 0.0));
    play(grown, 1.25, 2.0, MovieSeries<Dim>::resumed(path, words, 1.0));
    BOOST_TEST(content_of(path) == whole);
    std::ofstream(path, std::ios::trunc) << whole.substr(0, 20);
    for (const auto& file : {path, folder / "new.movie"}) {
        play(scene, 0.25, 1.0, MovieSeries<Dim>::resumed(file, words, 1.0));
        BOOST_TEST(content_of(file) == whole.substr(0, content_of(file).size()));
        BOOST_TEST(lines_of(file).size() == 8u);
    }
}

std::string complaint_of(const auto& act) {
    try {
        act();
    } catch (const talus::input_error& error) {
        return error.what();
    }
    return "none";
}

BOOST_AUTO_TEST_CASE_TEMPLATE(another_movie_is_not_gone_on_with, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("movie");
    const auto path = folder / "run.movie";
    Scene<Dim> scene(1);
    play(scene, 0.25, 1.0, MovieSeries<Dim>(path, words));
    const std::string whole = content_of(path), name = path.string();
    const auto other = [&](const MovieWords& changed) {
        return complaint_of([&] { MovieSeries<Dim>::resumed(path, changed, 1.0); });
    };
    BOOST_TEST(other({"Heap, \"unit\":\"m\"}", "load", "N"}) ==
               "title of the movie " + name +
                   R"( is "A \"pile\"", but must be "Heap, \"unit\":\"m\"}" to go on with it)");
    BOOST_TEST(other({words.title, "speed", "N"}) ==
               "scalar of the movie " + name +
                   R"( is "load", but must be "speed" to go on with it)");
    BOOST_TEST(other({words.title, "load", "kN"}) ==
               "unit of the movie " + name + R"( is "N", but must be "kN" to go on with it)");
    BOOST_TEST(complaint_of([&] { MovieSeries<5 - Dim>::resumed(path, words, 1.0); }) ==
               "dimension of the movie " + name + " is " + number(Dim) + ", but must be " +
                   number(5 - Dim) + " to go on with it");
    BOOST_TEST(content_of(path) == whole);
    // What is none, and what was damaged.
    std::ofstream(folder / "other", std::ios::binary) << "time [s],load [N]\n0.1,2\n";
    BOOST_TEST(complaint_of([&] { MovieSeries<Dim>::resumed(folder / "other", words, 1.0); }) ==
               "format of the movie " + (folder / "other").string() +
                   R"( is missing, but must be "talus movie" to go on with it)");
    for (const char* damage :
         {"{\"later\":3}\n", "{\"time\":0.5,\"bodies\":[]}\n", "{\"body\":\n"}) {
        std::ofstream(path, std::ios::binary) << whole << damage;
        const std::string said = complaint_of([&] { MovieSeries<Dim>::resumed(path, words, 9.0); });
        BOOST_TEST(said.starts_with("line 8 of " + name + " begins with '{"));
        BOOST_TEST(content_of(path) == whole + damage);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_killed_run_leaves_whole_lines, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("movie");
    const auto path = folder / "run.movie";
    Scene<Dim> scene(40);
    for (int trial = 0; trial < 10; ++trial) {
        const pid_t child = ::fork();
        BOOST_REQUIRE(child >= 0);
        if (child == 0) {
            MovieSeries<Dim> movie(path, words);
            for (int k = 1;; ++k) movie.add(k, scene.bodies, scene.shapes, scene.loads());
        }
        ::usleep(2000 + 1500 * static_cast<unsigned>(trial));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        auto movie = MovieSeries<Dim>::resumed(path, words, 1e9);
        const auto lines = lines_of(path);
        BOOST_REQUIRE(!lines.empty());
        for (const auto& line : lines) BOOST_TEST(line.back() == '}');
        movie.add(1e10, scene.bodies, scene.shapes, scene.loads());
        BOOST_TEST(content_of(path).ends_with("]}\n"));
        // A shape is told once in what there is.
        std::size_t count = 0;
        for (const auto& line : lines_of(path)) count += line.starts_with("{\"body\":7,") ? 1u : 0u;
        BOOST_TEST(count == 1u);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(bad_frames_are_refused_and_leave_no_trace, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("movie");
    const auto path = folder / "run.movie";
    Scene<Dim> scene(2);
    MovieSeries<Dim> movie(path, words);
    movie.add(1.0, scene.bodies, scene.shapes, scene.loads());
    const std::string whole = content_of(path);
    const auto said = [&](double time, const Shapes<Dim>& shapes, const std::vector<double>& load) {
        return complaint_of([&] { movie.add(time, scene.bodies, shapes, load); });
    };
    BOOST_TEST(said(1.0, scene.shapes, scene.loads()) ==
               "time of a frame is 1, but must be finite and later than the one before");
    BOOST_TEST(said(NAN, scene.shapes, scene.loads()).starts_with("time of a frame is "));
    BOOST_TEST(said(2.0, Shapes<Dim>{}, scene.loads()) ==
               "number of shapes of a frame is 0, but must be that of bodies, 3");
    BOOST_TEST(said(2.0, scene.shapes, {1.0}) ==
               "number of scalars of a frame is 1, but must be that of bodies, 3");
    scene.bodies.position[2][1] = NAN;
    BOOST_TEST(said(2.0, scene.shapes, scene.loads()).starts_with("position of body 2[1] is "));
    BOOST_TEST(content_of(path) == whole);
    // A frame that was refused told nothing: what came with it is told by the next.
    scene.add_ball(9.0);
    BOOST_TEST(said(2.0, scene.shapes, scene.loads()) != "none");
    scene.bodies.position[2][1] = 0.0;
    auto loads = scene.loads();
    loads[1] = NAN;
    loads[2] = -std::numeric_limits<double>::infinity();
    movie.add(2.0, scene.bodies, scene.shapes, loads);
    const auto lines = lines_of(path);
    BOOST_REQUIRE(lines.size() == 7u);
    BOOST_TEST(lines[5].starts_with("{\"body\":3,"));
    BOOST_TEST(lines[6].ends_with("\"scalars\":[2.5,null,null,2.5]}"));
    BOOST_CHECK_THROW(MovieSeries<Dim>(folder / "no" / "run.movie"), std::runtime_error);
    BOOST_CHECK_THROW(MovieSeries<Dim>::resumed(folder / "no" / "run.movie", words, 1.0),
                      std::runtime_error);
    MovieSeries<Dim> plain(folder / "plain.movie");
    BOOST_CHECK_THROW(plain.add(0.0, scene.bodies, scene.shapes, loads), talus::input_error);
}

BOOST_AUTO_TEST_CASE(words_cannot_break_a_line) {
    const TemporaryFolder folder("movie");
    MovieSeries<2> movie(folder / "run.movie", {.title = "a\nb\\ \x1b[31m \xff é"});
    BOOST_TEST(lines_of(folder / "run.movie").size() == 1u);
    BOOST_TEST(content_of(folder / "run.movie").find(R"("title":"a\\nb\\ \\x1b[31m \\xff é",)") !=
               std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_round_hole_tells_radius_centre_and_axis) {
    std::string text;
    talus::detail::add_shape<3>(
        text, talus::view_of<3>(talus::RoundHole<3>(2.5, talus::Vector<3>(0.0, 4.0, 0.0))));
    BOOST_TEST(text == R"({"kind":"hole","radius":2.5,"centre":[0,0,0],"axis":[0,1,0]})");
    text.clear();
    talus::detail::add_shape<2>(text, talus::view_of<2>(talus::RoundHole<2>(0.5)));
    BOOST_TEST(text == R"({"kind":"hole","radius":0.5,"centre":[0,0],"axis":[0,0]})");
}

BOOST_AUTO_TEST_SUITE_END()
