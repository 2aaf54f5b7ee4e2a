// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_gpf/core/analysis/position.h>
#include <pcl_gpf/core/sampling.h>

#include <array>
#include <vector>

/** \file
 * \brief Pieces of surfaces with exact distances. The rules (what is cut out of what) are those of the generator that
 * the peers of docs/quality.md were measured with, so that figures compare.
 */
namespace pcl_gpf::quality {

/** \brief Two coordinates of a point in an axis-parallel plane, in ascending order of the axes. */
using Planar = std::array<double, 2>;

/** \brief A piece of a surface. */
class Patch {
public:
  virtual ~Patch() = default;
  virtual double
  area() const = 0;
  /** \brief A point drawn evenly by area and its normal. */
  virtual void
  sample(SplitMix64& random, Position& point, Position& normal) const = 0;
  /** \brief Distance of `p`; infinite where another patch of the same model is nearer for certain. */
  virtual double
  distance(const Position& p) const = 0;
  /** \brief Unit outward normal at the point nearest to `p`. */
  virtual Position
  normalAt(const Position& p) const = 0;
};

/** \brief Rectangle at `axis` = `level` over [low, high] of the two other axes, without circles and rectangles cut out
 * of it. */
class RectanglePatch : public Patch {
public:
  struct Circle {
    Planar centre;
    double radius;
  };
  /** \brief Its rim is covered by other patches, to which its inside is left. */
  struct Hole {
    Planar low, high;
  };
  RectanglePatch(std::size_t axis, double level, Planar low, Planar high, double sign, std::vector<Circle> circles = {},
                 std::vector<Hole> holes = {});
  double
  area() const override;
  void
  sample(SplitMix64& random, Position& point, Position& normal) const override;
  double
  distance(const Position& p) const override;
  Position
  normalAt(const Position&) const override;

private:
  bool
  holds(const Planar& q) const;

  std::size_t axis_, u_, v_;
  double level_, sign_;
  Planar low_, high_;
  std::vector<Circle> circles_;
  std::vector<Hole> holes_;
};

/** \brief Wall of a cylinder along z; sign -1: a hole, whose outward normal points to the axis. */
class CylinderPatch : public Patch {
public:
  CylinderPatch(Planar centre, double radius, double low, double high, double sign)
      : centre_(centre)
      , radius_(radius)
      , low_(low)
      , high_(high)
      , sign_(sign)
  {
  }
  double
  area() const override;
  void
  sample(SplitMix64& random, Position& point, Position& normal) const override;
  double
  distance(const Position& p) const override;
  Position
  normalAt(const Position& p) const override;

private:
  Planar centre_;
  double radius_, low_, high_, sign_;
};

/** \brief Disk at z = `level`. */
class DiskPatch : public Patch {
public:
  DiskPatch(Planar centre, double level, double radius, double sign)
      : centre_(centre)
      , level_(level)
      , radius_(radius)
      , sign_(sign)
  {
  }
  double
  area() const override;
  void
  sample(SplitMix64& random, Position& point, Position& normal) const override;
  double
  distance(const Position& p) const override;
  Position
  normalAt(const Position&) const override
  {
    return {0, 0, sign_};
  }

private:
  Planar centre_;
  double level_, radius_, sign_;
};

/** \brief Upper part of a sphere of the given height; height = 2 radius: all of it, height <= radius: a cap. */
class CapPatch : public Patch {
public:
  CapPatch(const Position& centre, double radius, double height)
      : centre_(centre)
      , radius_(radius)
      , height_(height)
  {
  }
  double
  area() const override;
  void
  sample(SplitMix64& random, Position& point, Position& normal) const override;
  double
  distance(const Position& p) const override;
  Position
  normalAt(const Position& p) const override;

private:
  Position centre_;
  double radius_, height_;
};

/** \brief Torus about z. */
class TorusPatch : public Patch {
public:
  TorusPatch(double ring_radius, double tube_radius)
      : ring_(ring_radius)
      , tube_(tube_radius)
  {
  }
  double
  area() const override;
  void
  sample(SplitMix64& random, Position& point, Position& normal) const override;
  double
  distance(const Position& p) const override;
  Position
  normalAt(const Position& p) const override;

private:
  double ring_, tube_;
};

} // namespace pcl_gpf::quality
