// The keys of breccia-impact in print, for docs/case-reference.md.
#pragma once
#include <string>

namespace breccia {

/// Every key of a case of breccia-impact as tables in markdown: name, what is valid, default, kinds
/// of walls that take it, meaning.
std::string impact_reference();

}  // namespace breccia
