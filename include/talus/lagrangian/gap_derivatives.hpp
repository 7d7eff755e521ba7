// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/lagrangian/contact_list.hpp>
#include <talus/law/concepts.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

namespace talus {

/// The numbers that gaps are differentiated with: a value and its derivatives by time and all
/// coordinates at once, or, where their number is known at run time only, by one after the other
/// (then no number asks for memory).
template <int Dof>
using GapNumber =
    Eigen::AutoDiffScalar<Eigen::Matrix<double, Dof == Eigen::Dynamic ? 1 : Dof + 1, 1>>;

/// The possible contacts of a system by displacements alone: gaps, and how far the two sides have
/// slid past each other. `Real` is a GapNumber.
template <class RealType, int Rows, ContactLaw<Rows> LawType>
class GapList {
  public:
    using Real = RealType;
    using Law = LawType;
    struct Contact {
        Real gap;  ///< signed distance, > 0 apart [m]
        std::array<Real, static_cast<std::size_t>(Rows - 1)>
            slide;  ///< tangential displacements; zero unless set [m]
        Law law;
        std::string_view name;
    };

    /// A contact that has not slid: set `slide` in what is returned, which is good until the next
    /// `add`. The text of `name` must outlive the list.
    Contact& add(const Real& gap, const Law& law = {}, std::string_view name = {}) {
        Contact contact{gap, {}, law, name};
        contact.slide.fill(Real(0.0));
        items_.push_back(contact);
        return items_.back();
    }
    void clear() { items_.clear(); }
    std::size_t size() const { return items_.size(); }
    const Contact& operator[](std::size_t k) const { return items_[k]; }

  private:
    std::vector<Contact> items_;
};

/// G and W of contacts given by displacements, to rounding: G is the derivative of (gap, slide...)
/// by q, W that by t. Keeps its memory.
template <int Rows, int Dof, ContactLaw<Rows> Law>
class GapDerivatives {
  public:
    using Number = GapNumber<Dof>;

    /// Fills `out` from `system.gaps(t, q, list)`. Throws input_error if the system's contacts are
    /// not as many in each call, and what `gaps` throws.
    template <class System, class Coordinates>
    void evaluate(const System& system, double t, const Coordinates& q,
                  ContactList<Rows, Dof, Law>& out) {
        const Eigen::Index n = q.size();
        out.clear(n);
        q_.resize(n);
        for (Eigen::Index first = 0; first <= n; first += width) {
            for (Eigen::Index k = 0; k < n; ++k) q_[k] = seed(q[k], k - first);
            const Number time = seed(t, n - first);
            list_.clear();
            system.gaps(time, q_, list_);
            if (first == 0)
                for (std::size_t c = 0; c < list_.size(); ++c)
                    out.add(list_[c].gap.value(), list_[c].law, list_[c].name);
            require_count("contacts of the system", list_.size(), "its first call", out.size());
            for (std::size_t c = 0; c < list_.size(); ++c) take(list_[c], first, n, out[c]);
        }
    }

  private:
    static constexpr Eigen::Index width = Number::DerType::SizeAtCompileTime;

    /// x, whose derivative in direction `place` is 1.
    static Number seed(double x, Eigen::Index place) {
        Number number(x);
        if (place >= 0 && place < width) number.derivatives()[place] = 1.0;
        return number;
    }
    template <class Given, class Contact>
    static void take(const Given& given, Eigen::Index first, Eigen::Index n, Contact& c) {
        for (Eigen::Index k = first; k <= std::min(n, first + width - 1); ++k)
            for (int i = 0; i < Rows; ++i) {
                const Number& x = i == 0 ? given.gap : given.slide[static_cast<std::size_t>(i - 1)];
                (k < n ? c.rows(i, k) : c.prescribed[i]) = x.derivatives()[k - first];
            }
    }

    Eigen::Matrix<Number, Dof, 1> q_;
    GapList<Number, Rows, Law> list_;
};

}  // namespace talus
