// SPDX-License-Identifier: BSD-3-Clause
#include "rimls_fit.h"

#include <algorithm>
#include <cmath>

namespace pcl_gpf {

namespace {

/** Squared change of the gradient below which another fit is not worth its time (MeshLab's). */
constexpr float kSettled = 1e-3f;
/** A sum of weights below this has lost its digits, and its inverse may overflow. */
constexpr float kLeastWeight = 1e-25f;

} // namespace

RimlsFit::RimlsFit(const RimlsParameters& parameters, const RimlsSamples& samples)
: parameters_(parameters)
, gradient_(kBatch)
, normal_(kBatch)
, slope_(kBatch)
, tilt_(kBatch)
, value_(kBatch + kQueryBlock)
, weight_(kBatch + kQueryBlock)
, height_(kBatch + kQueryBlock)
, count_(kBatch + kQueryBlock)
, close_count_(kBatch + kQueryBlock)
, inverse_sq_(kBatch + kQueryBlock)
, plain_weight_(kBatch)
, inside_(kBatch)
, done_(kBatch)
{
  sums_.data = samples.points;
  sums_.data_normals = samples.normals.vectors();
  sums_.radius.inverse_sq_per_datum = samples.inverse_sq.data();
  sums_.value = value_.data();
  sums_.gradient = gradient_.vectors();
  sums_.normal_falloff = static_cast<float>(1.0 / (parameters.sigma_n * parameters.sigma_n));
  if (parameters.sigma_r > 0.0)
    sums_.residual_falloff = static_cast<float>(1.0 / (parameters.sigma_r * parameters.sigma_r));
  sums_.weight = weight_.data();
  sums_.height = height_.data();
  sums_.normal = normal_.vectors();
  sums_.slope = slope_.vectors();
  sums_.tilt = tilt_.vectors();
  sums_.close = static_cast<float>(parameters.domain * parameters.domain / (parameters.scale * parameters.scale));
  sums_.count = count_.data();
  sums_.close_count = close_count_.data();
  sums_.inverse_sq = inverse_sq_.data();
}

float
RimlsFit::reach(std::size_t i) const
{
  return std::sqrt(plain_weight_[i] / inverse_sq_[i]);
}

void
RimlsFit::run(const kernels::Candidates& candidates, kernels::Vectors<float> queries, std::size_t first,
              std::size_t count)
{
  sums_.queries = queries;
  sums_.first_output = first;
  const std::size_t first_block = first / kQueryBlock, blocks = blockCount(count);
  sums_.robust = false;
  kernels::active().implicit_sums(candidates, sums_, first_block, first_block + blocks);
  closePlainFit(count);
  sums_.robust = true;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t begin = block * kQueryBlock, end = std::min(count, begin + kQueryBlock);
    bool open = closeFit(begin, end);
    for (unsigned fit = 1; fit < parameters_.fits && open; ++fit) {
      kernels::active().implicit_sums(candidates, sums_, first_block + block, first_block + block + 1);
      open = closeFit(begin, end);
    }
  }
}

void
RimlsFit::closePlainFit(std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i) {
    inside_[i] = weight_[i] > kLeastWeight && count_[i] >= static_cast<float>(parameters_.minimum_samples) &&
                 close_count_[i] > 0.0f;
    done_[i] = !inside_[i];
    plain_weight_[i] = weight_[i];
    value_[i] = gradient_.x[i] = gradient_.y[i] = gradient_.z[i] = 0.0f;
  }
}

bool
RimlsFit::closeFit(std::size_t begin, std::size_t end)
{
  bool open = false;
  for (std::size_t i = begin; i < end; ++i) {
    if (done_[i])
      continue;
    if (!(weight_[i] > kLeastWeight)) { // no datum resembles the fit before: it is the last that means anything
      done_[i] = true;
      continue;
    }
    const float inverse = 1.0f / weight_[i];
    const float f = height_[i] * inverse;
    // grad f = (sum grad w f_i - f sum grad w + sum w n) / sum w with grad w = -8 s u.
    const float x = (normal_.x[i] - 8.0f * (tilt_.x[i] - f * slope_.x[i])) * inverse;
    const float y = (normal_.y[i] - 8.0f * (tilt_.y[i] - f * slope_.y[i])) * inverse;
    const float z = (normal_.z[i] - 8.0f * (tilt_.z[i] - f * slope_.z[i])) * inverse;
    const float dx = x - gradient_.x[i], dy = y - gradient_.y[i], dz = z - gradient_.z[i];
    done_[i] = !(dx * dx + dy * dy + dz * dz > kSettled);
    value_[i] = f;
    gradient_.x[i] = x;
    gradient_.y[i] = y;
    gradient_.z[i] = z;
    open = open || !done_[i];
  }
  return open;
}

} // namespace pcl_gpf
