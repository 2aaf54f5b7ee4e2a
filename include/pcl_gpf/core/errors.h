// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace pcl_gpf {

/** \brief A parameter is outside its documented range. The message names the parameter, its value and the range. */
class InvalidParameter : public std::invalid_argument {
public:
  using std::invalid_argument::invalid_argument;
};

/** \brief The data cannot be processed whatever the parameters are (nothing finite, all points identical, no usable normal). */
class UnsuitableData : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief The work asked for would need far more time or memory than the data justify; the message gives the figures. */
class ExcessiveWork : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief A progress callback returned false. */
class Cancelled : public std::runtime_error {
public:
  Cancelled() : std::runtime_error("cancelled by the progress callback") {}
};

} // namespace pcl_gpf
