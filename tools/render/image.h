// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace pcl_gpf {

/** \brief Red, green, blue as a screen shows them (sRGB), 0 .. 1. */
using Color = std::array<float, 3>;

/** \brief A picture, rows from the top. */
struct Image {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<Color> pixels;

  Image() = default;
  Image(std::size_t columns, std::size_t rows, Color color) : width(columns), height(rows), pixels(columns * rows, color) {}

  Color& at(std::size_t column, std::size_t row) { return pixels[row * width + column]; }
  const Color& at(std::size_t column, std::size_t row) const { return pixels[row * width + column]; }
};

/** \brief Half as wide and high, each pixel the mean of four: turns an image of twice the size into a smooth one. */
Image
halved(const Image& image);

/** \brief Copies `part` to (column, row) of `target`, where it must fit. */
void
paste(const Image& part, std::size_t column, std::size_t row, Image& target);

/** \brief The bytes of a PNG file, 8 bits a channel. \throws std::runtime_error if libpng fails */
std::vector<unsigned char>
encodePng(const Image& image);

} // namespace pcl_gpf
