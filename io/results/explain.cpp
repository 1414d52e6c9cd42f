#include "io/results/explain.hpp"

#include <fmt/format.h>

namespace breccia {
namespace {

std::string_view name_of(Criterion c) {
  switch (c) {
    case Criterion::uncoupled:
      return "uncoupled";
    case Criterion::coupled:
      return "coupled";
    case Criterion::mohr_coulomb:
      return "mohr-coulomb";
  }
  return "?";
}

std::string feature_line(std::string_view name, bool asked, bool built, std::string_view what) {
  return fmt::format("  {:<18}{:<6}{}\n", name, asked ? "on" : built ? "(on)" : "off", what);
}

template <class Table>
std::string columns_of(const Table& table, std::size_t& bytes) {
  std::string text;
  bytes = 0;
  table.for_each_column([&](const ColumnInfo& info, const auto& column) {
    const std::size_t each = sizeof(typename std::decay_t<decltype(column)>::value_type);
    text += fmt::format("  {:<20}{:>3} B  {:<7}{:<11}{}\n", info.name, column.empty() ? 0 : each, info.unit,
                        breccia::name_of(info.role),
                        column.empty() ? fmt::format("left out: no {}", breccia::name_of(info.need))
                                       : std::string(info.meaning));
    if (!column.empty()) bytes += each;
  });
  return text;
}

}  // namespace

std::string explain(const World& w) {
  const Features &asked = w.options.features, &built = w.features;
  std::string text = "features\n";
  text += feature_line("rotation", asked.rotation, built.rotation, "spins and torques");
  text += feature_line("contact damping", asked.contact_damping, built.contact_damping,
                       fmt::format("viscous force along each bond, {}", name_of(w.options.damping_scheme)));
  text +=
      feature_line("plasticity", asked.plasticity, built.plasticity, "three-slope envelope in compression");
  text += feature_line(
      "breakage", asked.breakage, built.breakage,
      fmt::format("damage, failure, friction afterwards; criterion {}", name_of(built.criterion)));
  text += feature_line("new contacts", w.options.new_contacts, w.options.new_contacts,
                       w.options.new_contacts
                           ? fmt::format("searched once a pair can meet: nearest are {:.3g} mm apart",
                                         w.neighbour_list.slack * 1e3)
                           : "surfaces pass through each other");
  text += feature_line("energy ledger", w.options.ledger, w.options.ledger,
                       "where the work goes, and the error of the balance");
  if (!(asked == built))
    text +=
        "  (on): left out by constants (no limit, no strength, no dashpot); no leaner kernel is built for "
        "this combination\n";
  std::size_t particle_bytes = 0, bond_bytes = 0;
  const std::string particle_columns = columns_of(w.particles, particle_bytes);
  const std::string bond_columns = columns_of(w.bonds, bond_bytes);
  text += fmt::format("\n{} particles of {} bytes\n{}", w.particles.size, particle_bytes, particle_columns);
  text += fmt::format("\n{} bonds of {} bytes\n{}", w.bonds.size, bond_bytes, bond_columns);
  if (!w.single.empty())
    text += fmt::format(
        "\nsingle precision: the loop reads records of {} bytes a particle and {} bytes a bond of its own, "
        "{} "
        "more where it is damaged, and adds to sums of {} bytes a particle; a quantum of length is {:.3g} m, "
        "one of force {:.3g} N\n",
        sizeof(MotionRecord), sizeof(BondBlock) / bond_block, sizeof(RareBlock) / bond_block,
        sizeof(IntegerSums), w.single.quanta.length, w.single.quanta.force);
  text += fmt::format("\nloops of a step, on {} thread{}\n", w.options.threads,
                      w.options.threads == 1 ? "" : "s");
  text += "  search       every 16 steps: has a particle used up the skin?\n";
  text += fmt::format("  confinement  {} particles of the lateral surface, where there is pressure\n",
                      w.confinement.rows.size());
  text += fmt::format("  bonds        {} bonds in batches, {}; {} shared particles\n", w.bonds.size,
                      name_of(w.options.instruction_set), w.bond_plan.shared.size());
  text += "  contacts     candidates within the skin, none yet\n";
  text += fmt::format("  platens      {} held particles\n", w.particles.size - w.particles.free);
  text += fmt::format("  integrate    {} particles\n", w.particles.size);
  return text;
}

}  // namespace breccia
