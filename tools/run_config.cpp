// SPDX-License-Identifier: BSD-3-Clause
#include "run_config.h"

#include <pcl_gpf/io/errors.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace pcl_gpf {

namespace {

using Json = nlohmann::ordered_json;

Json
parseFile(const std::string& path)
{
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.is_open() || file.bad() || text.empty())
    throw IoError(IoErrorKind::Unreadable, path, "", "a JSON object with options",
                  errno != 0 ? std::strerror(errno) : "an empty file");
  try {
    Json config = Json::parse(text);
    if (!config.is_object())
      throw IoError(IoErrorKind::Unreadable, path, "", "a JSON object with options", std::string("JSON of type ") + config.type_name());
    return config;
  } catch (const Json::parse_error& error) {
    throw IoError(IoErrorKind::Unreadable, path, "byte " + std::to_string(error.byte > 0 ? error.byte - 1 : 0), "JSON",
                  "something else");
  } catch (const Json::out_of_range&) {
    throw IoError(IoErrorKind::Unreadable, path, "", "numbers within the range of double", "one beyond it");
  }
}

bool
isFlag(const std::vector<OptionSpec>& table, const std::string& name)
{
  return std::any_of(table.begin(), table.end(),
                     [&name](const OptionSpec& spec) { return spec.name == name && spec.kind == OptionKind::Flag; });
}

std::string
valueOf(const Json& value, const std::string& name)
{
  if (value.is_string())
    return value.get<std::string>();
  if (value.is_number())
    return value.dump();
  if (value.is_boolean())
    return value.get<bool>() ? "on" : "off";
  if (!value.is_array() || value.empty())
    throw UsageError("'" + printable(name) + "' must be a text, a number, true, false or a list of them");
  std::string list;
  for (const Json& item : value) {
    if (item.is_structured() || item.is_null())
      throw UsageError("'" + printable(name) + "' must be a list of texts or numbers");
    list += (list.empty() ? "" : ",") + valueOf(item, name);
  }
  return list;
}

/** As words of a command line; objects put their name in front. */
void
addWords(const Json& object, const std::string& prefix, const std::vector<OptionSpec>& table, std::vector<std::string>& words)
{
  for (const auto& [key, value] : object.items()) {
    const std::string name = prefix + key;
    if (value.is_object() && prefix.empty())
      addWords(value, name + "-", table, words);
    else if (value.is_boolean() && isFlag(table, name)) {
      if (value.get<bool>())
        words.push_back("--" + name);
    } else
      words.push_back("--" + name + "=" + valueOf(value, name));
  }
}

} // namespace

Options
readConfig(const std::string& path, const std::vector<OptionSpec>& table)
{
  const Json config = parseFile(path);
  try {
    std::vector<std::string> words;
    addWords(config, "", table, words);
    return Options::parse(table, words, 0);
  } catch (const UsageError& error) {
    throw UsageError("'" + printable(path) + "': " + error.what());
  }
}

} // namespace pcl_gpf
