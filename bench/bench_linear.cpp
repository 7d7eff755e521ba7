// SPDX-License-Identifier: BSL-1.0
//
// The sparse factorisations that a cone engine could use, on the matrices that it really factors:
// the step of NewtonPolish after some sweeps on a generated problem, in the space of bodies
// (1 + B D^-1 B^T) and in that of contacts (W + D). talus::BlockLu in its two orders beside Eigen's
// SparseLU and, where they were found, UMFPACK and CHOLMOD; the latter, which needs symmetry, gets
// the symmetric part.
//
// Names are FAMILY-CONTACTS/SPACE/METHOD/{analysis,numeric,solve}; counters: `fill`, the numbers in
// the factors, and `error`, |b - A x| / |b| without refinement.
#include <talus/linear/block_lu.hpp>
#include <talus/solver/cones/central_pair.hpp>
#include <talus/solver/cones/cone_system.hpp>
#include <talus/solver/sweeps/accelerated_gauss_seidel.hpp>

#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "problem_families.hpp"
#ifdef TALUS_BENCH_SUITESPARSE
#include <cholmod.h>
#include <umfpack.h>
#endif

namespace bench {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vec = Eigen::VectorXd;

/// A matrix of small dense blocks, and the same number by number.
struct BlockMatrix {
    struct Block {
        int row, column;
        Eigen::MatrixXd value;
    };
    std::vector<int> node_size;
    std::vector<std::pair<int, int>> edges;
    std::vector<Block> blocks;
    Sparse a;

    void assemble() {
        std::vector<int> begin(1, 0);
        for (const int size : node_size) begin.push_back(begin.back() + size);
        std::vector<Eigen::Triplet<double>> entries;
        for (const Block& b : blocks) {
            if (b.row != b.column) edges.emplace_back(b.row, b.column);
            for (int i = 0; i < b.value.rows(); ++i)
                for (int j = 0; j < b.value.cols(); ++j)
                    entries.emplace_back(begin[static_cast<std::size_t>(b.row)] + i,
                                         begin[static_cast<std::size_t>(b.column)] + j,
                                         b.value(i, j));
        }
        a.resize(begin.back(), begin.back());
        a.setFromTriplets(entries.begin(), entries.end());
        a.makeCompressed();
    }
};

// --- methods -------------------------------------------------------------------------------------

class Method {
  public:
    virtual ~Method() = default;
    virtual void analyze(const BlockMatrix& m) = 0;
    virtual bool factorize(const BlockMatrix& m) = 0;
    virtual void solve(const BlockMatrix& m, const Vec& b, Vec& x) = 0;
    virtual double fill() const = 0;
};

class OwnLu : public Method {
  public:
    explicit OwnLu(talus::FrontalPlan::Ordering ordering) : ordering_(ordering) {}
    void analyze(const BlockMatrix& m) override {
        lu_.analyze(m.node_size, m.edges, ordering_);
        slots_.clear();
        for (const auto& b : m.blocks) slots_.push_back(lu_.slot(b.row, b.column));
    }
    bool factorize(const BlockMatrix& m) override {
        lu_.set_zero();
        for (std::size_t k = 0; k < m.blocks.size(); ++k) lu_.block(slots_[k]) += m.blocks[k].value;
        return lu_.factorize();
    }
    void solve(const BlockMatrix& /*m*/, const Vec& b, Vec& x) override {
        x = b;
        lu_.solve(x);
    }
    double fill() const override { return static_cast<double>(lu_.factor_size()); }

  private:
    talus::FrontalPlan::Ordering ordering_;
    talus::BlockLu lu_;
    std::vector<int> slots_;
};

template <class Ordering>
class EigenLu : public Method {
  public:
    void analyze(const BlockMatrix& m) override { lu_.analyzePattern(m.a); }
    bool factorize(const BlockMatrix& m) override {
        lu_.factorize(m.a);
        return lu_.info() == Eigen::Success;
    }
    void solve(const BlockMatrix& /*m*/, const Vec& b, Vec& x) override { x = lu_.solve(b); }
    double fill() const override { return static_cast<double>(lu_.nnzL() + lu_.nnzU()); }

  private:
    Eigen::SparseLU<Sparse, Ordering> lu_;
};

#ifdef TALUS_BENCH_SUITESPARSE
class Umfpack : public Method {
  public:
    Umfpack() { umfpack_di_defaults(control_.data()); }
    ~Umfpack() override {
        umfpack_di_free_numeric(&numeric_);
        umfpack_di_free_symbolic(&symbolic_);
    }
    void analyze(const BlockMatrix& m) override {
        umfpack_di_free_symbolic(&symbolic_);
        const int n = static_cast<int>(m.a.rows());
        umfpack_di_symbolic(n, n, m.a.outerIndexPtr(), m.a.innerIndexPtr(), m.a.valuePtr(),
                            &symbolic_, control_.data(), info_.data());
    }
    bool factorize(const BlockMatrix& m) override {
        umfpack_di_free_numeric(&numeric_);
        return umfpack_di_numeric(m.a.outerIndexPtr(), m.a.innerIndexPtr(), m.a.valuePtr(),
                                  symbolic_, &numeric_, control_.data(),
                                  info_.data()) == UMFPACK_OK;
    }
    void solve(const BlockMatrix& m, const Vec& b, Vec& x) override {
        x.resize(b.size());
        control_[UMFPACK_IRSTEP] = 0;
        umfpack_di_solve(UMFPACK_A, m.a.outerIndexPtr(), m.a.innerIndexPtr(), m.a.valuePtr(),
                         x.data(), b.data(), numeric_, control_.data(), info_.data());
    }
    double fill() const override { return info_[UMFPACK_LNZ] + info_[UMFPACK_UNZ]; }

  private:
    std::array<double, UMFPACK_CONTROL> control_{};
    std::array<double, UMFPACK_INFO> info_{};
    void* symbolic_ = nullptr;
    void* numeric_ = nullptr;
};

/// Supernodal Cholesky of the symmetric part, ordered by METIS: half the work of an LU, of another
/// matrix. Its error is that of the symmetric part.
class Cholmod : public Method {
  public:
    Cholmod() {
        cholmod_start(&common_);
        common_.nmethods = 1;
        common_.method[0].ordering = CHOLMOD_METIS;
        common_.supernodal = CHOLMOD_SUPERNODAL;
        common_.postorder = 1;
    }
    Cholmod(const Cholmod&) = delete;
    Cholmod& operator=(const Cholmod&) = delete;
    ~Cholmod() override {
        cholmod_free_factor(&factor_, &common_);
        cholmod_finish(&common_);
    }
    void analyze(const BlockMatrix& m) override {
        take(m);
        cholmod_free_factor(&factor_, &common_);
        factor_ = cholmod_analyze(&view_, &common_);
        fill_ = common_.lnz;
    }
    bool factorize(const BlockMatrix& m) override {
        take(m);
        cholmod_factorize(&view_, factor_, &common_);
        return common_.status == CHOLMOD_OK;
    }
    void solve(const BlockMatrix& /*m*/, const Vec& b, Vec& x) override {
        cholmod_dense right{};
        right.nrow = right.nzmax = right.d = static_cast<std::size_t>(b.size());
        right.ncol = 1;
        right.x = const_cast<double*>(b.data());
        right.xtype = CHOLMOD_REAL;
        cholmod_dense* const result = cholmod_solve(CHOLMOD_A, factor_, &right, &common_);
        x = Eigen::Map<const Vec>(static_cast<const double*>(result->x), b.size());
        cholmod_dense* owned = result;
        cholmod_free_dense(&owned, &common_);
    }
    double fill() const override { return fill_; }

  private:
    /// The symmetric part is a copy, made once per matrix and not timed by the others either.
    void take(const BlockMatrix& m) {
        if (taken_ == &m) return;
        taken_ = &m;
        symmetric_ = 0.5 * (m.a + Sparse(m.a.transpose()));
        symmetric_.makeCompressed();
        view_ = {};
        view_.nrow = view_.ncol = static_cast<std::size_t>(symmetric_.rows());
        view_.nzmax = static_cast<std::size_t>(symmetric_.nonZeros());
        view_.p = symmetric_.outerIndexPtr();
        view_.i = symmetric_.innerIndexPtr();
        view_.x = symmetric_.valuePtr();
        view_.stype = -1;  // the lower half is read
        view_.itype = CHOLMOD_INT;
        view_.xtype = CHOLMOD_REAL;
        view_.dtype = CHOLMOD_DOUBLE;
        view_.sorted = view_.packed = 1;
    }
    const BlockMatrix* taken_ = nullptr;
    Sparse symmetric_;
    cholmod_common common_{};
    cholmod_sparse view_{};
    cholmod_factor* factor_ = nullptr;
    double fill_ = 0.0;
};
#endif

using MakeMethod = std::function<std::unique_ptr<Method>()>;

std::vector<std::pair<std::string, MakeMethod>> methods() {
    using Ordering = talus::FrontalPlan::Ordering;
    const auto own = [](Ordering ordering) {
        return [=] { return std::make_unique<OwnLu>(ordering); };
    };
    return {
        {"block_lu", own(Ordering::better)},
        {"block_lu_minimum_degree", own(Ordering::minimum_degree)},
        {"block_lu_nested_dissection", own(Ordering::nested_dissection)},
        {"eigen_sparse_lu_colamd",
         [] { return std::make_unique<EigenLu<Eigen::COLAMDOrdering<int>>>(); }},
        {"eigen_sparse_lu_amd",
         [] { return std::make_unique<EigenLu<Eigen::AMDOrdering<int>>>(); }},
#ifdef TALUS_BENCH_SUITESPARSE
        {"umfpack", [] { return std::make_unique<Umfpack>(); }},
        {"cholmod_metis_symmetric_part", [] { return std::make_unique<Cholmod>(); }},
#endif
    };
}

// --- matrices ------------------------------------------------------------------------------------

/// Impulses at which the polish would begin.
template <int Dim>
std::vector<talus::Vector<Dim>> swept(const BenchProblem<Dim>& problem) {
    std::vector<talus::Vector<Dim>> r(problem.contact_count(), talus::Vector<Dim>::Zero());
    talus::AcceleratedGaussSeidel<Dim, Law<Dim>> sweeps({.max_iterations = 60, .tolerance = 1e-6});
    sweeps.solve(*problem.bodies(), r);
    return r;
}

/// D of NewtonPolish at r.
template <int Dim>
std::vector<talus::Matrix<Dim>> diagonal(const talus::ConeSystem<Dim>& system,
                                         std::span<const talus::Vector<Dim>> impulses) {
    Vec r, u;
    system.to_scaled(impulses, r);
    system.multiply(r, u);
    u += system.free_velocity();
    const double scale = std::max(r.norm(), system.free_velocity().norm());
    const double error = system.residual(r, u) * scale;
    const double eps = 1e-4 * error * error / static_cast<double>(system.contact_count()) + 1e-300;
    constexpr double proximal = 1e-10;
    std::vector<talus::Matrix<Dim>> d;
    for (std::size_t c = 0; c < system.contact_count(); ++c) {
        const auto i = system.first(c);
        const talus::Vector<Dim> x = (r - u).template segment<Dim>(i);
        d.push_back(talus::central_pair<Dim>(x, system.cone(c).mu, eps).d +
                    proximal * talus::Matrix<Dim>::Identity());
    }
    return d;
}

template <int Dim>
BlockMatrix in_body_space(const talus::BodyMap<Dim>& map,
                          const std::vector<talus::Matrix<Dim>>& d) {
    BlockMatrix m;
    m.node_size.assign(map.body_sizes().begin(), map.body_sizes().end());
    std::map<std::pair<int, int>, Eigen::MatrixXd> sum;
    for (int k = 0; k < static_cast<int>(m.node_size.size()); ++k) {
        const int n = m.node_size[static_cast<std::size_t>(k)];
        sum[{k, k}] = Eigen::MatrixXd::Identity(n, n);
    }
    for (std::size_t c = 0; c < map.contact_count(); ++c) {
        const talus::Matrix<Dim> inverse = d[c].inverse();
        for (const auto& a : map.entries(c))
            for (const auto& b : map.entries(c)) {
                const Eigen::MatrixXd value = map.block(a) * inverse * map.block(b).transpose();
                auto [place, is_new] = sum.try_emplace({a.body, b.body}, value);
                if (!is_new) place->second += value;
            }
    }
    for (auto& [place, value] : sum) m.blocks.push_back({place.first, place.second, value});
    m.assemble();
    return m;
}

template <int Dim>
BlockMatrix in_contact_space(const talus::ConeSystem<Dim>& system,
                             const std::vector<talus::Matrix<Dim>>& d) {
    BlockMatrix m;
    m.node_size.assign(system.contact_count(), Dim);
    for (std::size_t i = 0; i < system.contact_count(); ++i)
        for (std::size_t k = 0; k < system.columns(i).size(); ++k) {
            Eigen::MatrixXd value = system.row_block(i, k);
            const std::size_t j = system.columns(i)[k];
            if (i == j) value += d[i];
            m.blocks.push_back({static_cast<int>(i), static_cast<int>(j), value});
        }
    m.assemble();
    return m;
}

template <int Dim>
BlockMatrix matrix_of(const BenchProblem<Dim>& problem, bool bodies) {
    std::vector<talus::FrictionCone<Dim>> cones;
    for (const auto& law : problem.laws()) cones.push_back(law.friction_cone());
    const auto& p = *problem.bodies();
    const auto impulses = swept(problem);
    talus::ResidualMeasure<Dim> measure;
    talus::ConeSystem<Dim> system;
    if (bodies) {
        measure.prepare(talus::DelassusProduct<Dim>(p.jacobian, p.inverse_mass));
        system.assign(talus::BodyMap<Dim>(p.jacobian, p.inverse_mass), p.free_velocity, cones,
                      measure);
        return in_body_space(*system.bodies(), diagonal<Dim>(system, impulses));
    }
    measure.prepare(problem.assembled().delassus);
    system.assign(problem.assembled().delassus, p.free_velocity, cones, measure);
    return in_contact_space(system, diagonal<Dim>(system, impulses));
}

// --- runs ----------------------------------------------------------------------------------------

/// Holds the matrix in use, and no other.
struct Workshop {
    std::string name;
    std::unique_ptr<BlockMatrix> matrix;
    const BlockMatrix& get(const ProblemEntry& entry, bool bodies) {
        const std::string wanted = entry.name + (bodies ? "/bodies" : "/contacts");
        if (name != wanted) {
            const AnyProblem problem = entry.make();
            matrix = std::make_unique<BlockMatrix>(
                std::visit([&](const auto& p) { return matrix_of(p, bodies); }, problem));
            name = wanted;
        }
        return *matrix;
    }
};

enum class Stage { analysis, numeric, solve };

void run(benchmark::State& state, const BlockMatrix& m, Method& method, Stage stage) {
    const Vec b = Vec::LinSpaced(m.a.rows(), -1.0, 1.0);
    Vec x;
    if (stage != Stage::analysis) method.analyze(m);
    bool good = true;
    if (stage == Stage::solve) good = method.factorize(m);
    for (auto _ : state) {
        if (stage == Stage::analysis) method.analyze(m);
        if (stage == Stage::numeric) good = method.factorize(m);
        if (stage == Stage::solve) method.solve(m, b, x);
    }
    if (!good) return state.SkipWithError("did not factorise");
    state.counters["rows"] = static_cast<double>(m.a.rows());
    state.counters["numbers"] = static_cast<double>(m.a.nonZeros());
    if (stage == Stage::numeric) state.counters["fill"] = method.fill();
    if (stage == Stage::solve) state.counters["error"] = (b - m.a * x).norm() / b.norm();
}

void register_all(const std::vector<ProblemEntry>& problems, Workshop& workshop) {
    for (const ProblemEntry& entry : problems)
        for (const bool bodies : {true, false})
            for (const auto& [name, make] : methods())
                for (const auto& [word, stage] :
                     {std::pair{"analysis", Stage::analysis}, std::pair{"numeric", Stage::numeric},
                      std::pair{"solve", Stage::solve}}) {
                    const std::string title =
                        entry.name + (bodies ? "/bodies/" : "/contacts/") + name + "/" + word;
                    benchmark::RegisterBenchmark(title.c_str(), [&entry, &workshop, bodies,
                                                                 make = make, stage = stage](
                                                                    benchmark::State& state) {
                        run(state, workshop.get(entry, bodies), *make(), stage);
                    })->Unit(benchmark::kMillisecond);
                }
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
    try {
        const std::array<std::size_t, 2> sizes{1000, 10000};
        constexpr std::uint64_t seed = 1;
        auto problems = bench::generated_problems(sizes, seed);
        std::erase_if(problems, [](const auto& p) {
            const bool kept = p.name.starts_with("wall_2d") || p.name.starts_with("rest_") ||
                              p.name.starts_with("fcc_pyramid");
            return !kept || p.name.ends_with("perturbed");
        });
        bench::Workshop workshop;
        bench::register_all(problems, workshop);
        benchmark::Initialize(&argc, argv);
        if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
        benchmark::RunSpecifiedBenchmarks();
        benchmark::Shutdown();
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bench_linear: %s\n", e.what());
        return 1;
    }
}
