// Words about the number of the engine's threads.
import type { EngineInfo } from 'sillon';
import { t } from './text.js';

/** Words of the chip that shows the number of threads. @param asked  the setting with which the engine was started */
export function threadsWords(
  { threads, reasonCode }: EngineInfo,
  asked: 'auto' | 'off' | number,
): { count: string; why: string } {
  const count = t('threads.count', { n: threads });
  if (threads > 1) return { count, why: '' };
  if (asked === 'off') return { count, why: t('threads.off') };
  if (reasonCode === '') return { count, why: t('threads.one') };
  if (reasonCode === 'GivenUp') return { count, why: t('threads.givenUp') };
  const framed = globalThis.parent !== (globalThis.window as typeof globalThis.window | undefined);
  return { count, why: t(framed ? 'threads.frame' : 'threads.isolation') };
}
