// SPDX-License-Identifier: BSD-3-Clause
#include "support/local_cloud.h"

#include <pcl_gpf/core/errors.h>
#include <pcl_gpf/core/operators/local_noise.h>
#include <pcl_gpf/core/soa_buffer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pcl_gpf::test {
namespace {

struct Moved {
  Shape shape;
  std::vector<float> moves, weights;

  explicit Moved(Shape filtered) : shape(std::move(filtered))
  {
    SplitMix64 random(2);
    for (std::size_t i = 0; i < shape.size(); ++i) {
      moves.push_back(static_cast<float>(0.01 * std::abs(random.normal())));
      weights.push_back(static_cast<float>(random.uniform()));
    }
  }
  std::vector<float>
  noise(double radius, double spacing, bool weighted, unsigned threads = 0) const
  {
    return localNoise({radius, spacing, threads}, toBuffer(shape.points).view(), toBuffer(shape.normals).view(), moves.data(),
                      weighted ? weights.data() : nullptr);
  }
};

double
literalNoise(const Moved& cloud, double radius, bool weighted, std::size_t i)
{
  const double falloff = 1 / (1 - std::cos(30 * 3.14159265358979323846 / 180));
  double squares = 0, shares = 0;
  for (std::size_t j = 0; j < cloud.shape.size(); ++j) {
    if (distance(cloud.shape.points[i], cloud.shape.points[j]) >= radius)
      continue;
    double cosine = 0;
    for (std::size_t a = 0; a < 3; ++a)
      cosine += cloud.shape.normals[i][a] * cloud.shape.normals[j][a];
    const double weight = std::exp(-std::pow((1 - std::abs(cosine)) * falloff, 2)) * (weighted ? cloud.weights[j] : 1.0);
    squares += weight * cloud.moves[j] * cloud.moves[j];
    shares += weight;
  }
  return std::sqrt(squares / shares);
}

TEST(LocalNoise, agreesWithALiteralEvaluation)
{
  const Moved cloud(sphere(2000, 0, 6));
  for (const bool weighted : {false, true}) {
    const std::vector<float> sigma = cloud.noise(0.15, 0.04, weighted);
    for (std::size_t i = 0; i < sigma.size(); ++i)
      ASSERT_NEAR(sigma[i], literalNoise(cloud, 0.15, weighted, i), 2e-3 * sigma[i]) << i;
  }
}

TEST(LocalNoise, tellsTwoFacesApart)
{
  Moved cloud(edge(20000, 0, 3));
  for (std::size_t i = 0; i < cloud.shape.size(); ++i)
    cloud.moves[i] = cloud.shape.normals[i][2] > 0.5 ? 0.02f : 0.005f;
  const std::vector<float> sigma = cloud.noise(0.05, 0.01, false);
  for (std::size_t i = 0; i < sigma.size(); ++i)
    ASSERT_NEAR(sigma[i], cloud.moves[i], 1e-3 * cloud.moves[i]);
}

TEST(LocalNoise, ofDensePointsIsThatOfEverySoManyth)
{
  const Moved cloud(plane(20000, 0, 4)); // 2,500 in a ball, of which at least 256 count
  const std::vector<float> sigma = cloud.noise(0.2, 0.007, false);
  for (const float value : sigma)
    ASSERT_NEAR(value, 0.01, 0.0025);
}

TEST(LocalNoise, doesNotDependOnThreadsTakesFewPointsAndRefusesBadParameters)
{
  const Moved cloud(cube(3000, 0, 5));
  EXPECT_EQ(cloud.noise(0.1, 0.04, true, 1), cloud.noise(0.1, 0.04, true, 3));
  for (const std::size_t count : {0u, 1u, 2u, 3u})
    EXPECT_EQ(Moved(plane(count)).noise(0.1, 0.04, false).size(), count);
  Moved unheard(plane(3));
  unheard.weights.assign(3, 0.0f);
  EXPECT_EQ(unheard.noise(0.1, 0.04, true), std::vector<float>(3, 0.0f));
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(cloud.noise(bad, 0.04, false), InvalidParameter);
    EXPECT_THROW(cloud.noise(0.1, bad, false), InvalidParameter);
  }
}

} // namespace
} // namespace pcl_gpf::test
