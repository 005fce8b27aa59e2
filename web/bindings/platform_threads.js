// What an application says about threads, where emscripten would ask a page: node has no navigator, and its own thread may wait.
mergeInto(LibraryManager.library, {
  // package/module.js says it.
  emscripten_num_logical_cores: function() {
    return Module['cores'] || 1;
  },
  // package/module.js has no threads where waiting is forbidden.
  emscripten_check_blocking_allowed: function() {},
});
