// SPDX-License-Identifier: BSD-3-Clause
#include "signed_forest.h"

#include <cstdlib>
#include <numeric>

namespace pcl_gpf {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/** Votes between two groups, added up. */
struct Link {
  std::uint32_t to;
  float sum;   ///< of the signed votes
  float total; ///< of their magnitudes

  /** How much the votes weigh, times how much they agree. */
  float
  strength() const
  {
    return total > 0.0f ? sum / total * sum : 0.0f;
  }
};

struct LinkRows {
  std::vector<std::size_t> offsets{0};
  std::vector<Link> links;

  std::size_t size() const { return offsets.size() - 1; }
};

/** Sets with a sign relative to their root. */
class SignedSets {
public:
  explicit SignedSets(std::size_t size) : parent_(size), sign_(size, 1)
  {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /** Root of a; `sign` becomes that of a relative to it. */
  std::uint32_t
  find(std::uint32_t a, int& sign)
  {
    std::uint32_t root = a;
    sign = 1;
    for (; parent_[root] != root; root = parent_[root])
      sign *= sign_[root];
    int rest = sign;
    while (parent_[a] != root && a != root) { // everything on the way hangs below the root from now on
      const std::uint32_t next = parent_[a];
      const int own = sign_[a];
      parent_[a] = root;
      sign_[a] = static_cast<std::int8_t>(rest);
      rest *= own;
      a = next;
    }
    return root;
  }

  /** \return false if both are in one set already */
  bool
  unite(std::uint32_t a, std::uint32_t b, int relative)
  {
    int sign_a, sign_b;
    const std::uint32_t root_a = find(a, sign_a), root_b = find(b, sign_b);
    if (root_a == root_b)
      return false;
    const std::uint32_t low = root_a < root_b ? root_a : root_b, high = root_a < root_b ? root_b : root_a;
    parent_[high] = low; // the smaller number stays the root, so that roots come in order
    sign_[high] = static_cast<std::int8_t>(sign_a * sign_b * relative);
    return true;
  }

private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::int8_t> sign_;
};

/** Numbers the sets from 0 in order. */
SignedGroups
numbered(SignedSets& sets, std::size_t size)
{
  SignedGroups groups;
  groups.group.resize(size);
  groups.sign.resize(size);
  for (std::uint32_t a = 0; a < size; ++a) {
    int sign;
    const std::uint32_t root = sets.find(a, sign);
    groups.group[a] = root == a ? static_cast<std::uint32_t>(groups.count++) : groups.group[root];
    groups.sign[a] = static_cast<std::int8_t>(sign);
  }
  return groups;
}

/** Members of each group, in order. */
struct Members {
  Members(const SignedGroups& groups) : offsets(groups.count + 1, 0), rows(groups.group.size())
  {
    for (const std::uint32_t g : groups.group)
      ++offsets[g + 1];
    for (std::size_t g = 0; g < groups.count; ++g)
      offsets[g + 1] += offsets[g];
    std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
    for (std::size_t a = 0; a < rows.size(); ++a)
      rows[next[groups.group[a]]++] = static_cast<std::uint32_t>(a);
  }
  std::vector<std::size_t> offsets;
  std::vector<std::uint32_t> rows;
};

/** Links between groups, from the links or votes of their members. */
template <typename ForEachLink>
LinkRows
contract(const SignedGroups& groups, const ForEachLink& for_each_link)
{
  const Members members(groups);
  LinkRows result;
  std::vector<std::uint32_t> place(groups.count, kNone); // of the link to each group in the row being built
  for (std::uint32_t g = 0; g < groups.count; ++g) {
    const std::size_t start = result.links.size();
    for (std::size_t m = members.offsets[g]; m < members.offsets[g + 1]; ++m) {
      const std::uint32_t a = members.rows[m];
      for_each_link(a, [&](const Link& link) {
        const std::uint32_t to = groups.group[link.to];
        if (to == g)
          return;
        if (place[to] == kNone) {
          place[to] = static_cast<std::uint32_t>(result.links.size() - start);
          result.links.push_back({to, 0.0f, 0.0f});
        }
        Link& sum = result.links[start + place[to]];
        sum.sum += groups.sign[a] == groups.sign[link.to] ? link.sum : -link.sum;
        sum.total += link.total;
      });
    }
    for (std::size_t e = start; e < result.links.size(); ++e)
      place[result.links[e].to] = kNone;
    result.offsets.push_back(result.links.size());
  }
  return result;
}

/** Joins each row with the strongest of its links; ties go to the smaller number. */
template <typename ForEachLink>
SignedGroups
joinStrongest(std::size_t rows, const ForEachLink& for_each_link)
{
  SignedSets sets(rows);
  for (std::uint32_t a = 0; a < rows; ++a) {
    Link best{kNone, 0.0f, 0.0f};
    for_each_link(a, [&](const Link& link) {
      const float gain = link.strength() - best.strength();
      if (best.to == kNone || gain > 0.0f || (gain == 0.0f && link.to < best.to))
        best = link;
    });
    if (best.to != kNone)
      sets.unite(a, best.to, best.sum < 0.0f ? -1 : 1);
  }
  return numbered(sets, rows);
}

void
compose(SignedGroups& groups, const SignedGroups& of_groups)
{
  for (std::size_t i = 0; i < groups.group.size(); ++i) {
    groups.sign[i] = static_cast<std::int8_t>(groups.sign[i] * of_groups.sign[groups.group[i]]);
    groups.group[i] = of_groups.group[groups.group[i]];
  }
  groups.count = of_groups.count;
}

} // namespace

SignedGroups
singleGroups(std::size_t size)
{
  SignedGroups groups;
  groups.group.resize(size);
  std::iota(groups.group.begin(), groups.group.end(), 0u);
  groups.sign.assign(size, 1);
  groups.count = size;
  return groups;
}

void
joinGroups(const VoteRows& rows, SignedGroups& groups)
{
  const auto votes = [&](std::uint32_t i, const auto& take) {
    for (std::size_t e = rows.offsets[i]; e < rows.offsets[i + 1]; ++e)
      take(Link{rows.neighbors[e], static_cast<float>(rows.votes[e]), static_cast<float>(std::abs(rows.votes[e]))});
  };
  LinkRows links;
  const auto sums = [&](std::uint32_t a, const auto& take) {
    for (std::size_t e = links.offsets[a]; e < links.offsets[a + 1]; ++e)
      take(links.links[e]);
  };
  if (groups.count == rows.size()) // nothing to add up yet, and the most rows of all rounds
    groups = joinStrongest(rows.size(), votes);
  for (links = contract(groups, votes); !links.links.empty();) {
    const SignedGroups joined = joinStrongest(links.size(), sums);
    compose(groups, joined);
    links = contract(joined, sums);
  }
}

void
followMajority(const VoteRows& rows, SignedGroups& groups, unsigned sweeps)
{
  for (unsigned sweep = 0; sweep < sweeps; ++sweep) {
    bool turned = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      int sum = 0;
      for (std::size_t e = rows.offsets[i]; e < rows.offsets[i + 1]; ++e)
        sum += rows.votes[e] * groups.sign[rows.neighbors[e]];
      if (sum * groups.sign[i] < 0) {
        groups.sign[i] = static_cast<std::int8_t>(-groups.sign[i]);
        turned = true;
      }
    }
    if (!turned)
      return;
  }
}

} // namespace pcl_gpf
