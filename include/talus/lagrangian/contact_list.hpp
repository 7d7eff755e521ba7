// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/input.hpp>
#include <talus/core/types.hpp>
#include <talus/law/concepts.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace talus {

/// A possible contact of a system with coordinates q, at some (t, q): what the paper calls the gap
/// g, and G and W of  U = G u + W  [Moreau, (1) and (4)].
template <int Rows, int Dof, ContactLaw<Rows> LawType>
struct LagrangianContact {
    double gap;  ///< signed distance, > 0 apart [m]
    /// G: row 0 is the normal relative velocity per qdot, the derivative of the gap by q; the
    /// others are the tangential ones. Zero unless set: a contact without friction has row 0 alone.
    Eigen::Matrix<double, Rows, Dof> rows;
    /// W: relative velocity at qdot = 0, of what moves as told; row 0 is the derivative of the gap
    /// by t. Zero unless set [m/s].
    Vector<Rows> prescribed;
    LawType law;            ///< between U and the impulse
    std::string_view name;  ///< for messages and reports; may be empty

    /// U = G u + W [m/s].
    template <class Velocity>
    Vector<Rows> relative_velocity(const Velocity& u) const {
        Vector<Rows> result = prescribed;
        for (int i = 0; i < Rows; ++i)
            for (Eigen::Index j = 0; j < rows.cols(); ++j) result[i] += rows(i, j) * u[j];
        return result;
    }
};

/// All possible contacts of a system, closed or not, in an order that is the same in every call:
/// a contact is known by its place. Keeps its memory.
template <int Rows, int Dof, ContactLaw<Rows> LawType>
class ContactList {
  public:
    using Law = LawType;
    using Contact = LagrangianContact<Rows, Dof, Law>;

    /// A contact of this gap [m], its rows and prescribed velocity zero: set them in what is
    /// returned, which is good until the next `add`. The text of `name` must outlive the list, as a
    /// literal does.
    Contact& add(double gap, const Law& law = {}, std::string_view name = {}) {
        if (count_ == items_.size())
            items_.push_back(Contact{gap, Eigen::Matrix<double, Rows, Dof>::Zero(Rows, dof_),
                                     Vector<Rows>::Zero(), law, name});
        Contact& c = items_[count_++];
        c.gap = gap;
        c.rows.setZero(Rows, dof_);
        c.prescribed = Vector<Rows>::Zero();
        c.law = law;
        c.name = name;
        return c;
    }
    /// Forgets the contacts; those to come have `dof` columns.
    void clear(Eigen::Index dof) {
        count_ = 0;
        dof_ = dof;
    }

    std::size_t size() const { return count_; }
    Contact& operator[](std::size_t k) { return items_[k]; }
    const Contact& operator[](std::size_t k) const { return items_[k]; }
    const Contact* begin() const { return items_.data(); }
    const Contact* end() const { return items_.data() + count_; }

  private:
    std::vector<Contact> items_;  // those from count_ on are kept for their memory
    std::size_t count_ = 0;
    Eigen::Index dof_ = 0;
};

namespace detail {

/// "contact 2 (beak)".
inline std::string contact_text(std::size_t k, std::string_view name) {
    std::string text = numbered("contact", k);
    if (!name.empty()) text += " (" + std::string(name) + ")";
    return text;
}
/// "item at t = 0.5 s".
inline std::string at_time(std::string_view item, double t) {
    return std::string(item) + " at t = " + text_of(t) + " s";
}
/// "normal row", "tangential row 1".
inline std::string row_text(int row) {
    return row == 0 ? "normal row" : numbered("tangential row", static_cast<std::size_t>(row));
}

}  // namespace detail
}  // namespace talus
