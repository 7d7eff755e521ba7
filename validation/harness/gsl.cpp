// SPDX-License-Identifier: BSL-1.0
#include "gsl.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_multifit.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_poly.h>
#include <gsl/gsl_roots.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

namespace validation::gsl {

namespace {

/// GSL aborts on errors unless told otherwise.
const bool handler_off = [] {
    gsl_set_error_handler_off();
    return true;
}();

void require(int status, const char* what) {
    if (status != GSL_SUCCESS)
        throw std::runtime_error(std::string(what) + ": " + gsl_strerror(status));
}

double call(double x, void* f) { return (*static_cast<const Function*>(f))(x); }

gsl_function wrapped(const Function& f) {
    return {&call, const_cast<void*>(static_cast<const void*>(&f))};
}

template <auto Free>
struct Deleter {
    template <class T>
    void operator()(T* p) const {
        Free(p);
    }
};
template <class T, auto Free>
using Handle = std::unique_ptr<T, Deleter<Free>>;

int call_ode(double t, const double y[], double dy[], void* p) {
    const auto& [f, n] = *static_cast<const std::pair<const RightHandSide*, std::size_t>*>(p);
    (*f)(t, {y, n}, {dy, n});
    return GSL_SUCCESS;
}

/// The integrator and what it points to.
class Integrator {
  public:
    Integrator(const RightHandSide& f, std::size_t n)
        : parameters_(&f, n), system_{&call_ode, nullptr, n, &parameters_} {
        driver_.reset(
            gsl_odeiv2_driver_alloc_y_new(&system_, gsl_odeiv2_step_rk8pd, 1e-6, 1e-13, 1e-12));
    }
    void advance(double& t, double to, std::vector<double>& y) {
        gsl_odeiv2_driver_reset_hstart(driver_.get(), to > t ? 1e-6 : -1e-6);
        require(gsl_odeiv2_driver_apply(driver_.get(), &t, to, y.data()), "ode");
    }

  private:
    std::pair<const RightHandSide*, std::size_t> parameters_;
    gsl_odeiv2_system system_;
    Handle<gsl_odeiv2_driver, gsl_odeiv2_driver_free> driver_;
};

}  // namespace

double root(const Function& f, double low, double high) {
    Handle<gsl_root_fsolver, gsl_root_fsolver_free> solver(
        gsl_root_fsolver_alloc(gsl_root_fsolver_brent));
    gsl_function wrap = wrapped(f);
    require(gsl_root_fsolver_set(solver.get(), &wrap, low, high), "root");
    for (int k = 0; k < 200; ++k) {
        require(gsl_root_fsolver_iterate(solver.get()), "root");
        low = gsl_root_fsolver_x_lower(solver.get());
        high = gsl_root_fsolver_x_upper(solver.get());
        if (gsl_root_test_interval(low, high, 1e-300, 4e-16) == GSL_SUCCESS) break;
    }
    return gsl_root_fsolver_root(solver.get());
}

double minimum(const Function& f, double low, double guess, double high) {
    Handle<gsl_min_fminimizer, gsl_min_fminimizer_free> solver(
        gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent));
    gsl_function wrap = wrapped(f);
    require(gsl_min_fminimizer_set(solver.get(), &wrap, guess, low, high), "minimum");
    for (int k = 0; k < 200; ++k) {
        require(gsl_min_fminimizer_iterate(solver.get()), "minimum");
        if (gsl_min_test_interval(gsl_min_fminimizer_x_lower(solver.get()),
                                  gsl_min_fminimizer_x_upper(solver.get()), 1e-12,
                                  1e-10) == GSL_SUCCESS)
            break;
    }
    return gsl_min_fminimizer_x_minimum(solver.get());
}

double integral(const Function& f, double low, double high) {
    Handle<gsl_integration_workspace, gsl_integration_workspace_free> space(
        gsl_integration_workspace_alloc(2000));
    gsl_function wrap = wrapped(f);
    double result = 0.0, error = 0.0;
    require(gsl_integration_qags(&wrap, low, high, 0.0, 1e-11, 2000, space.get(), &result, &error),
            "integral");
    return result;
}

std::vector<std::vector<double>> ode(const RightHandSide& f, std::vector<double> y,
                                     std::span<const double> times) {
    Integrator integrator(f, y.size());
    std::vector<std::vector<double>> states{y};
    double t = times[0];
    for (std::size_t k = 1; k < times.size(); ++k) {
        if (times[k] != t) integrator.advance(t, times[k], y);
        states.push_back(y);
    }
    return states;
}

double ode_until(const RightHandSide& f, double t, std::vector<double>& y,
                 const std::function<double(double, std::span<const double>)>& event,
                 double t_max) {
    constexpr int parts = 2000;
    Integrator integrator(f, y.size());
    const double step = (t_max - t) / parts;
    const bool positive = event(t, y) > 0.0;
    const auto over = [&](double at, const std::vector<double>& state) {
        return (event(at, state) > 0.0) != positive;
    };
    double low = t;
    for (int k = 1; k <= parts; ++k) {
        std::vector<double> next = y;
        double at = low;
        integrator.advance(at, t + k * step, next);
        if (!over(at, next)) {
            low = at;
            y = next;
            continue;
        }
        double high = at;
        for (int i = 0; i < 80 && high - low > 4e-16 * std::abs(high); ++i) {
            const double mid = 0.5 * (low + high);
            std::vector<double> state = y;
            double time = low;
            integrator.advance(time, mid, state);
            if (over(mid, state)) {
                high = mid;
            } else {
                low = mid;
                y = state;
            }
        }
        return low;
    }
    throw std::runtime_error("ode_until: the event did not happen");
}

double ellint_K(double k) { return gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE); }

Jacobi jacobi(double u, double m) {
    Jacobi j{};
    require(gsl_sf_elljac_e(u, m, &j.sn, &j.cn, &j.dn), "elljac");
    return j;
}

Line fit_line(std::span<const double> x, std::span<const double> y) {
    Line line{};
    double c00 = 0, c01 = 0, c11 = 0, squares = 0;
    require(gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &line.intercept, &line.slope, &c00,
                           &c01, &c11, &squares),
            "fit");
    line.slope_error = std::sqrt(c11);
    return line;
}

std::vector<double> fit_linear(const std::vector<std::vector<double>>& rows,
                               std::span<const double> y) {
    const std::size_t n = rows.size(), p = rows.at(0).size();
    Handle<gsl_multifit_linear_workspace, gsl_multifit_linear_free> space(
        gsl_multifit_linear_alloc(n, p));
    Handle<gsl_matrix, gsl_matrix_free> x(gsl_matrix_alloc(n, p)), cov(gsl_matrix_alloc(p, p));
    Handle<gsl_vector, gsl_vector_free> rhs(gsl_vector_alloc(n)), c(gsl_vector_alloc(p));
    for (std::size_t i = 0; i < n; ++i) {
        gsl_vector_set(rhs.get(), i, y[i]);
        for (std::size_t k = 0; k < p; ++k) gsl_matrix_set(x.get(), i, k, rows[i].at(k));
    }
    double squares = 0.0;
    require(gsl_multifit_linear(x.get(), rhs.get(), c.get(), cov.get(), &squares, space.get()),
            "fit");
    std::vector<double> result(p);
    for (std::size_t k = 0; k < p; ++k) result[k] = gsl_vector_get(c.get(), k);
    return result;
}

std::vector<double> quadratic_roots(double a, double b, double c) {
    double low = 0.0, high = 0.0;
    const int count = gsl_poly_solve_quadratic(a, b, c, &low, &high);
    if (count == 0) return {};
    if (count == 1) return {low};
    return {low, high};
}

double student_quantile(double probability, double freedom) {
    return gsl_cdf_tdist_Pinv(0.5 + 0.5 * probability, freedom);
}

}  // namespace validation::gsl
