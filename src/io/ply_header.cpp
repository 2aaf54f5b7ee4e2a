// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_header.h"

#include <optional>
#include <unordered_set>

#include "io/format_limits.h"
#include "io/format_readers.h"

namespace pcl_gpf {

namespace {

struct PlyTypeName {
  const char* name;
  const char* sized_name;
  FieldType type;
};

constexpr PlyTypeName kPlyTypes[] = {
    {"char", "int8", FieldType::Int8},        {"uchar", "uint8", FieldType::UInt8},
    {"short", "int16", FieldType::Int16},     {"ushort", "uint16", FieldType::UInt16},
    {"int", "int32", FieldType::Int32},       {"uint", "uint32", FieldType::UInt32},
    {"float", "float32", FieldType::Float32}, {"double", "float64", FieldType::Float64}};

/** One header in the making. */
class PlyHeaderParser {
public:
  explicit PlyHeaderParser(LineReader& lines)
      : lines_(lines)
      , first_byte_(lines.position()) {}

  PlyHeader parse() {
    std::string_view line = nextLine();
    if (trimmed(line) != "ply") lines_.fail("the line 'ply'", quoted(line));
    do {
      line = nextLine();
    } while (!takeLine(line));
    if (!has_format_) lines_.fail("a format line in the PLY header", "none");
    checkPromises();
    return std::move(header_);
  }

private:
  using Tokens = std::vector<std::string_view>;

  std::string_view nextLine() {
    std::string_view line;
    if (!lines_.next(line)) lines_.fail("end_header at the end of the PLY header", "the end of the file");
    if (lines_.position() - first_byte_ > kMaxHeaderBytes) lines_.fail("a PLY header of at most 1 MiB", "more");
    if (line.find('\0') != std::string_view::npos) lines_.fail("text in the PLY header", "a NUL byte");
    return line;
  }

  /** Returns true for end_header. */
  bool takeLine(std::string_view line) {
    std::string_view rest = line;
    std::string_view keyword;
    if (!takeToken(rest, keyword)) return false;
    if (keyword == "comment") {
      header_.comments.push_back(trimmed(rest));
      return false;
    }
    if (keyword == "obj_info") {
      header_.comments.push_back(trimmed(line));
      return false;
    }
    const Tokens values = splitTokens(rest);
    if (keyword == "end_header" && values.empty()) return true;
    if (keyword == "format")
      takeFormat(values);
    else if (keyword == "element")
      takeElement(values);
    else if (keyword == "property")
      takeProperty(values);
    else
      lines_.fail("format, comment, obj_info, element, property or end_header", quoted(trimmed(line)));
    return false;
  }

  void takeFormat(const Tokens& values) {
    if (has_format_) lines_.fail("one format line", "a second one");
    has_format_ = true;
    if (values.size() != 2 || values[1] != "1.0")
      lines_.fail("format KIND 1.0", values.size() < 2 ? "fewer values" : quoted(values.back()));
    if (values[0] == "ascii")
      header_.format = CloudFormat::PlyAscii;
    else if (values[0] == "binary_little_endian")
      header_.format = CloudFormat::PlyLittleEndian;
    else if (values[0] == "binary_big_endian")
      header_.format = CloudFormat::PlyBigEndian;
    else
      lines_.fail("format ascii, binary_little_endian or binary_big_endian", quoted(values[0]));
  }

  void takeElement(const Tokens& values) {
    if (values.size() != 2) lines_.fail("element NAME COUNT", std::to_string(values.size()) + " values");
    if (header_.elements.size() == kMaxElements) lines_.fail("at most 10000 elements", "more");
    std::string name(values[0]);
    if (!element_names_.insert(name).second) lines_.fail("every element once", quoted(name) + " twice");
    header_.elements.push_back({std::move(name), parseCount(lines_, values[1], "the number of entries"), {}});
    property_names_.clear();
  }

  FieldType typeNamed(std::string_view name) const {
    for (const PlyTypeName& known : kPlyTypes)
      if (name == known.name || name == known.sized_name) return known.type;
    lines_.fail("a PLY type such as float, double, uchar or int", quoted(name));
  }

  void takeProperty(const Tokens& values) {
    if (header_.elements.empty()) lines_.fail("an element before its properties", "a property");
    PlyProperty property;
    property.is_list = !values.empty() && values[0] == "list";
    if (values.size() != (property.is_list ? 4U : 2U))
      lines_.fail("property TYPE NAME or property list TYPE TYPE NAME", std::to_string(values.size()) + " values");
    property.type = typeNamed(values[values.size() - 2]);
    if (property.is_list) property.length_type = typeNamed(values[1]);
    if (property.length_type == FieldType::Float32 || property.length_type == FieldType::Float64)
      lines_.fail("an integer type for the length of a list", quoted(values[1]));
    property.name = std::string(values.back());
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    if (properties.size() == kMaxFields) lines_.fail("at most 1000 properties", "more");
    if (!property_names_.insert(property.name).second)
      lines_.fail("every property once", quoted(property.name) + " twice");
    properties.push_back(std::move(property));
  }

  /** Everything that is promised must be there at its smallest, before anything is allocated for it. */
  void checkPromises() const {
    std::size_t left = lines_.bytesLeft();
    for (const PlyElement& element : header_.elements) {
      if (element.count == 0) continue;
      if (element.properties.empty())
        lines_.fail("properties for the " + std::to_string(element.count) + " entries of element " +
                        quoted(element.name),
                    "none");
      const bool is_text = header_.format == CloudFormat::PlyAscii;
      const std::uint64_t row = is_text ? 2 * element.properties.size() - 1 : element.minimumBytes();
      requireBytes(lines_.source(), lines_.position(), element.count, row, left);
      left -= static_cast<std::size_t>(element.count * row);
    }
  }

  LineReader& lines_;
  std::size_t first_byte_;
  PlyHeader header_;
  bool has_format_ = false;
  std::unordered_set<std::string> element_names_, property_names_;
};

} // namespace

const PlyProperty* PlyElement::find(const std::string& property) const noexcept {
  for (const PlyProperty& candidate : properties)
    if (candidate.name == property) return &candidate;
  return nullptr;
}

bool PlyElement::hasLists() const noexcept {
  for (const PlyProperty& property : properties)
    if (property.is_list) return true;
  return false;
}

std::size_t PlyElement::minimumBytes() const noexcept {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties)
    bytes += sizeOf(property.is_list ? property.length_type : property.type);
  return bytes;
}

PlyHeader readPlyHeader(LineReader& lines) {
  return PlyHeaderParser(lines).parse();
}

const char* plyTypeName(FieldType type) noexcept {
  for (const PlyTypeName& known : kPlyTypes)
    if (known.type == type) return known.name;
  return nullptr;
}

} // namespace pcl_gpf
