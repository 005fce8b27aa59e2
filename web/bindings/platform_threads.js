// Substitutes for Emscripten functions that assume a page: node has no navigator, and its main
// thread may block.
mergeInto(LibraryManager.library, {
  // package/module.js sets it.
  emscripten_num_logical_cores: function() {
    return Module['cores'] || 1;
  },
  // package/module.js makes no threads where blocking is forbidden.
  emscripten_check_blocking_allowed: function() {},
});
