// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/core/check.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace talus {

namespace detail {

/// Memory for n items of that size and alignment. Throws std::bad_alloc.
inline void* allocate(std::size_t n, std::size_t size, std::size_t alignment) {
    if (n > static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max()) / size)
        throw std::bad_array_new_length();
    return alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__
               ? ::operator new (n* size, std::align_val_t{alignment})
               : ::operator new(n* size);
}
inline void deallocate(void* place, std::size_t alignment) noexcept {
    if (alignment > __STDCPP_DEFAULT_NEW_ALIGNMENT__)
        ::operator delete (place, std::align_val_t{alignment});
    else
        ::operator delete(place);
}

}  // namespace detail

/// One field of many bodies or contacts, one after the other in memory: what std::vector is, with
/// the members that talus needs, and any integer for an index. A compiler makes some sixty
/// functions of a std::vector for each type that it holds; a step holds seventy types, and this one
/// takes a sixth off the time to compile it (bench/README.md). It is a contiguous range, so a
/// std::span of it needs no word, and becomes a std::vector, or is made of one, where one is asked
/// for. References and iterators are lost where a std::vector's would be. What it holds moves
/// without an exception.
template <class T>
class Column {
  public:
    using value_type = T;
    using iterator = T*;
    using const_iterator = const T*;

    Column() noexcept = default;
    explicit Column(std::size_t n) : Column() { resize(n); }
    Column(std::size_t n, const T& x) : Column() { assign(n, x); }
    Column(std::initializer_list<T> list) : Column() { append(list.begin(), list.end()); }
    Column(const std::vector<T>& list) : Column() {
        append(list.data(), list.data() + list.size());
    }
    explicit Column(std::span<const T> items) : Column() { append(items); }
    Column(const Column& other) : Column() { append(other.begin_, other.end_); }
    Column(Column&& other) noexcept { swap(other); }
    ~Column() {
        static_assert(std::is_nothrow_move_constructible_v<T>,
                      "what a Column holds must move without an exception");
        clear();
        release();
    }
    Column& operator=(const Column& other) {
        if (this != &other) {
            clear();
            append(other.begin_, other.end_);
        }
        return *this;
    }
    Column& operator=(Column&& other) noexcept {
        swap(other);
        return *this;
    }
    operator std::vector<T>() const { return std::vector<T>(begin_, end_); }
    void swap(Column& other) noexcept {
        std::swap(begin_, other.begin_);
        std::swap(end_, other.end_);
        std::swap(room_, other.room_);
    }
    friend void swap(Column& a, Column& b) noexcept { a.swap(b); }

    T* data() { return begin_; }
    const T* data() const { return begin_; }
    T* begin() { return begin_; }
    T* end() { return end_; }
    const T* begin() const { return begin_; }
    const T* end() const { return end_; }
    std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
    std::size_t capacity() const { return static_cast<std::size_t>(room_ - begin_); }
    bool empty() const { return end_ == begin_; }

    T& operator[](std::integral auto i) {
        check(static_cast<std::size_t>(i));
        return begin_[i];
    }
    const T& operator[](std::integral auto i) const {
        check(static_cast<std::size_t>(i));
        return begin_[i];
    }
    T& front() { return (*this)[0]; }
    const T& front() const { return (*this)[0]; }
    T& back() { return (*this)[size() - 1]; }
    const T& back() const { return (*this)[size() - 1]; }

    void clear() { end_at(begin_); }
    /// Room for n in all, exactly.
    void reserve(std::size_t n) {
        if (n > capacity()) move_to_room_for(n);
    }
    void resize(std::size_t n) {
        make_room(n);
        for (T* const end = begin_ + n; end_ < end; ++end_) ::new (static_cast<void*>(end_)) T();
        end_at(begin_ + n);
    }
    void resize(std::size_t n, const T& value) {
        // Which may be one of its own. NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
        const T x = value;
        make_room(n);
        for (T* const end = begin_ + n; end_ < end; ++end_) ::new (static_cast<void*>(end_)) T(x);
        end_at(begin_ + n);
    }
    void assign(std::size_t n, const T& value) {
        // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
        const T x = value;
        clear();
        resize(n, x);
    }
    /// In place of what there is; `items` are none of its own.
    void assign(std::span<const T> items) {
        clear();
        append(items);
    }
    template <class Iterator>
    requires(!std::integral<Iterator>) void assign(Iterator from, Iterator to) {
        clear();
        for (; from != to; ++from) push_back(*from);
    }
    void append(std::span<const T> items) { append(items.data(), items.data() + items.size()); }
    void push_back(T x) {
        make_room(size() + 1);
        ::new (static_cast<void*>(end_)) T(std::move(x));
        ++end_;
    }
    void pop_back() { end_at(end_ - 1); }
    /// Before `at`, which is an iterator of its own.
    void insert(const T* at, T x) {
        const std::ptrdiff_t k = at - begin_;
        push_back(std::move(x));
        for (T* p = end_ - 1; p != begin_ + k; --p) std::swap(*p, p[-1]);
    }
    void erase(const T* from, const T* to) {
        if (from == to) return;
        T* kept = begin_ + (from - begin_);
        for (T* next = begin_ + (to - begin_); next != end_; ++next) *kept++ = std::move(*next);
        end_at(kept);
    }
    void erase(const T* at) { erase(at, at + 1); }

    /// Takes out the items for which `gone(item)` holds, and returns how many they were.
    template <class Gone>
    std::size_t erase_if(Gone&& gone) {
        T* kept = begin_;
        for (T& x : *this)
            if (!gone(std::as_const(x))) {
                if (kept != &x) *kept = std::move(x);
                ++kept;
            }
        const auto erased = static_cast<std::size_t>(end_ - kept);
        end_at(kept);
        return erased;
    }
    friend bool operator==(const Column& a, const Column& b) {
        bool equal = a.size() == b.size();
        for (std::size_t i = 0; equal && i < a.size(); ++i) equal = a.begin_[i] == b.begin_[i];
        return equal;
    }

  private:
    /// Where the standard library checks its own: a tenth of a step's time, or two.
    void check([[maybe_unused]] std::size_t i) const {
#ifdef _GLIBCXX_ASSERTIONS
        TALUS_CHECK(i < size(), "an index below the size");
#endif
    }
    [[gnu::noinline]] void append(const T* from, const T* to) {
        make_room(size() + static_cast<std::size_t>(to - from));
        for (; from != to; ++from, ++end_) ::new (static_cast<void*>(end_)) T(*from);
    }
    void make_room(std::size_t n) {
        if (n > capacity()) move_to_room_for(n < 2 * size() ? 2 * size() : n);
    }
    [[gnu::noinline]] void move_to_room_for(std::size_t n) {
        T* const place = static_cast<T*>(detail::allocate(n, sizeof(T), alignof(T)));
        T* end = place;
        for (T* p = begin_; p != end_; ++p, ++end) ::new (static_cast<void*>(end)) T(std::move(*p));
        clear();
        release();
        begin_ = place;
        end_ = end;
        room_ = place + n;
    }
    void end_at(T* end) {
        if constexpr (std::is_trivially_destructible_v<T>)
            end_ = end;
        else
            while (end_ > end) (--end_)->~T();
    }
    void release() {
        if (begin_ != nullptr) detail::deallocate(begin_, alignof(T));
    }

    T* begin_ = nullptr;
    T* end_ = nullptr;
    T* room_ = nullptr;
};

/// One entry for each body.
template <class T>
using PerBody = Column<T>;

}  // namespace talus
