// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/views.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace pcl_gpf {

/** \brief Owning array of trivial values, 64-byte aligned and readable for one full vector beyond its end.
 *
 * The padding lets a kernel load whole vectors without a tail loop; it holds zeros.
 */
template <typename T>
class AlignedArray {
  static_assert(std::is_trivially_copyable<T>::value, "AlignedArray holds plain values only");

public:
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kPadding = 64 / sizeof(T);

  AlignedArray() = default;
  explicit AlignedArray(std::size_t size, T value = T{}) { assign(size, value); }
  AlignedArray(AlignedArray&& other) noexcept : data_(std::move(other.data_)), size_(other.size_) { other.size_ = 0; }
  AlignedArray&
  operator=(AlignedArray&& other) noexcept
  {
    data_ = std::move(other.data_);
    size_ = other.size_;
    other.size_ = 0;
    return *this;
  }

  /** \brief Makes the array `size` long, every element `value`. \throws std::bad_alloc */
  void
  assign(std::size_t size, T value = T{})
  {
    const std::size_t padded = (size + 2 * kPadding - 1) / kPadding * kPadding;
    if (size > static_cast<std::size_t>(-1) / sizeof(T) / 2)
      throw std::bad_alloc();
    data_.reset(); // first: the new array may take the room of the old
    size_ = 0;
    data_.reset(allocate(padded));
    size_ = size;
    std::fill_n(data_.get(), size, value);
    std::fill_n(data_.get() + size, padded - size, T{});
  }

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }
  T* begin() { return data_.get(); }
  T* end() { return data_.get() + size_; }
  const T* begin() const { return data_.get(); }
  const T* end() const { return data_.get() + size_; }

private:
  /** From malloc() and not from aligned_alloc(), which does not find the hole that a freed array of the same size left behind: the
   * peak of memory would be a quarter higher. The address to free stands before the first element. */
  static T*
  allocate(std::size_t count)
  {
    void* const whole = std::malloc(count * sizeof(T) + kAlignment + sizeof(void*));
    if (!whole)
      throw std::bad_alloc();
    const auto first = reinterpret_cast<std::uintptr_t>(whole) + sizeof(void*) + kAlignment - 1;
    void** const aligned = reinterpret_cast<void**>(first - first % kAlignment);
    aligned[-1] = whole;
    return reinterpret_cast<T*>(aligned);
  }

  struct Free {
    void operator()(T* p) const { std::free(reinterpret_cast<void**>(p)[-1]); }
  };
  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0;
};

/** \brief Owning storage behind a VectorsView: three AlignedArrays of floats. */
struct SoaBuffer {
  AlignedArray<float> x, y, z;

  SoaBuffer() = default;
  explicit SoaBuffer(std::size_t size) : x(size), y(size), z(size) {}

  std::size_t size() const { return x.size(); }
  VectorsView view() const { return {x.data(), y.data(), z.data(), size()}; }
  MutableVectorsView view() { return {x.data(), y.data(), z.data(), size()}; }
};

/** \brief The vectors at `places`, in that order. \param[in] places any unsigned integers below from.size */
template <typename Index>
SoaBuffer
elementsOf(VectorsView from, const std::vector<Index>& places)
{
  SoaBuffer to(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    to.x[k] = from.x[places[k]];
    to.y[k] = from.y[places[k]];
    to.z[k] = from.z[places[k]];
  }
  return to;
}

} // namespace pcl_gpf
