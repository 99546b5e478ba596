// A sign that a worker sees while it computes.
import type { Wanted } from './protocol.js';

export interface StopSign {
  /** What the worker watches, where it does not watch the flag by itself. */
  wanted: Wanted;
  raise(): void;
  /** The call is over. */
  forget(): void;
}

/** @param flag  one byte of shared memory; 1 asks to stop. */
export function flagSign(flag: Uint8Array, wanted: Wanted): StopSign {
  return {
    wanted,
    raise() {
      Atomics.store(flag, 0, 1);
    },
    forget() {},
  };
}

/** Shared memory where there is some, else an address that is withdrawn. */
export function stopSign(): StopSign {
  const shared =
    typeof SharedArrayBuffer !== 'undefined' && (globalThis.crossOriginIsolated as boolean | undefined) !== false;
  if (shared) {
    const flag = new Uint8Array(new SharedArrayBuffer(1));
    return flagSign(flag, flag);
  }
  const wanted = URL.createObjectURL(new Blob(['wanted']));
  const forget = (): void => {
    URL.revokeObjectURL(wanted);
  };
  return { wanted, raise: forget, forget };
}
