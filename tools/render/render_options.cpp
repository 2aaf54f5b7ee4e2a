// SPDX-License-Identifier: BSD-3-Clause
#include "render_options.h"

#include "../option_groups.h"

#include <limits>
#include <string>

namespace pcl_gpf {

namespace {

OptionSpec
pixels(const std::string& name, const std::string& default_text, const std::string& help)
{
  OptionSpec spec{name, OptionKind::Count, "N", default_text, help};
  spec.least = 16;
  spec.most = 4096;
  return spec;
}

OptionSpec
choice(const std::string& name, const std::vector<std::string>& choices, const std::string& help)
{
  OptionSpec spec{name, OptionKind::Choice, "", choices[0], help};
  spec.choices = choices;
  return spec;
}

OptionSpec
number(const std::string& name, const std::string& default_text, double least, double most, const std::string& help)
{
  OptionSpec spec{name, OptionKind::Number, "X", default_text, help};
  spec.least = least;
  spec.most = most;
  return spec;
}

} // namespace

std::vector<OptionSpec>
renderOptions()
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {outputOption(),
          pixels("width", "900", "width of each cloud's part of the picture, pixels"),
          pixels("height", "700", "height of the picture of a cloud, pixels"),
          {"view", OptionKind::Vector, "X,Y,Z", "",
           "direction from the cloud to the viewer; without it from the sensor's side or three quarters from above"},
          {"up", OptionKind::Vector, "X,Y,Z", "", "what is up in the picture; z when only --view is given"},
          number("zoom", "1", 1e-3, 1e6, "magnification"),
          {"center", OptionKind::Vector, "FX,FY,FZ", "",
           "what is in the middle, as fractions of the first cloud's box: 0.5,0.5,1 is the middle of its top"},
          {"crop-min", OptionKind::Vector, "FX,FY,FZ", "0,0,0", "show only points above this corner, fractions of the box"},
          {"crop-max", OptionKind::Vector, "FX,FY,FZ", "1,1,1", "show only points below this corner, fractions of the box"},
          choice("section", {"none", "x", "y", "z"}, "show a thin slice across this axis as dots: are edges sharp or round?"),
          number("section-at", "0.5", 0, 1, "where the slice is, fraction of the box"),
          {"section-thickness", OptionKind::Length, "LENGTH", "2x", "thickness of the slice"},
          {"color", OptionKind::Text, "NAME", "shade", "shade (light and shadow), rgb (colours of the file), or a field"},
          number("low", "", -kInfinity, kInfinity, "value of the field that is dark; without it that of the lowest 2 %"),
          number("high", "", -kInfinity, kInfinity, "value of the field that is bright; without it that of the highest 2 %"),
          choice("normals", {"auto", "file", "estimate"}, "normals for the light; auto: of the files when all have them"),
          {"normal-radius", OptionKind::Length, "LENGTH", "3x", "radius in which they are estimated"},
          {"splat", OptionKind::Length, "LENGTH", "auto", "radius of the discs that are drawn; auto is 1.4x"},
          {"labels", OptionKind::Text, "A,B", "auto", "text above each cloud; auto: file names above several; none"},
          overwriteOption(),
          threadsOption()};
}

void
checkRenderOptions(const Options& options)
{
  if (isSection(options) && (options.given("view") || options.given("up")))
    throw UsageError("--section looks along its own axis; leave --view and --up away");
  if (options.given("view") && length(vectorOption(options, "view")) <= 0)
    throw UsageError("option '--view': 0,0,0 is no direction");
  if (options.given("up") && length(vectorOption(options, "up")) <= 0)
    throw UsageError("option '--up': 0,0,0 is no direction");
  for (const char* name : {"normal-radius", "section-thickness"})
    if (options.length(name).unit == Length::Unit::Auto)
      throw UsageError(std::string("option '--") + name + "': there is no automatic value; give a length");
}

bool
isSection(const Options& options)
{
  return options.text("section") != "none";
}

Position
vectorOption(const Options& options, const std::string& name)
{
  const std::vector<double> values = options.vector(name);
  return {values[0], values[1], values[2]};
}

} // namespace pcl_gpf
