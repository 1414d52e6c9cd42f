#include "core/loading/load_test.hpp"

#include "core/loading/stages.hpp"

namespace breccia {

void run_load_test(World& w, const Assembly& assembly, const LoadTest& test, const LoadHooks& hooks,
                   LoadState& state, LoadResult& result) {
  Run run{w, assembly, test, hooks, state, result, result.run_time};
  if (state.stage == Stage::not_begun) state.checks = make_stability_checks(w);
  if (test.loading == Loading::hydrostatic)
    press_evenly(run);
  else if (test.confinement == 0.0 || state.stage == Stage::loading || press_hydrostatically(run))
    load(run);
  note_run_time(run);
}

void run_load_test(World& w, const Assembly& assembly, const LoadTest& test, const LoadHooks& hooks,
                   LoadResult& result) {
  LoadState state;
  run_load_test(w, assembly, test, hooks, state, result);
}

}  // namespace breccia
