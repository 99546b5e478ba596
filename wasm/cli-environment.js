/* global Module, ENV -- of the glue code around it */
// Part of the compiled command line: getenv sees the process's own environment.
Module['preRun'] = () => Object.assign(ENV, process.env);
