// Judges a report for somebody who is about to print. Limits were set by eye from rendered examples. The sentences are
// in the dictionary as `verdict.TEXT`, see i18n/say-verdict.ts.
import type { NeighbourDelay, Report } from 'sillon';

export type Measure =
  | 'path'
  | 'coverage'
  | 'overlap'
  | 'alignment'
  | 'uTurns'
  | 'kinks'
  | 'widths'
  | 'fill'
  | 'lost'
  | 'crossings'
  | 'order'
  | 'squeezed'
  | 'picture';
export type Level = 'good' | 'fair' | 'poor';

export type VerdictText =
  | `${'coverage' | 'overlap' | 'uTurns' | 'widths' | 'lost' | 'alignment' | 'picture'}.${Level}`
  | `${'kinks' | 'fill' | 'order' | 'squeezed'}.${'good' | 'fair'}`
  | 'alignment.free'
  | 'uTurns.needed'
  | 'path.one'
  | 'path.many'
  | 'path.apart'
  | 'crossings.poor';

export interface Verdict {
  measure: Measure;
  level: Level;
  text: VerdictText;
  values: Readonly<Record<string, number>>;
}

/** A verdict whose sentence follows from its level. */
const judged = <M extends Measure, L extends Level>(measure: M, level: L, values: Verdict['values']) => ({
  measure,
  level,
  text: `${measure}.${level}` as const,
  values,
});

/** Level of a value between two limits. @param rising  true where larger values are worse */
const levelBetween = (value: number, good: number, fair: number, rising: boolean): Level => {
  const sign = rising ? 1 : -1;
  if (sign * value <= sign * good) return 'good';
  return sign * value <= sign * fair ? 'fair' : 'poor';
};

/** Contrast, the brightest places' light divided by the darkest', below which a picture cannot be seen however alike
 * it is. From here up to `appearance.weakContrast` it is only faint. */
const unseenContrast = 2;

const round = (value: number, digits: number): number => Number(value.toFixed(digits));

/** All verdicts on a report; empty for one without measures. */
export function verdictsOf(report: Report): Verdict[] {
  if (report.coverage === undefined) return []; // the measures come together
  const measured = report as Required<Report>;
  const { spacing, width, coverage, overlap, uTurns, kinks, crossings, fillRatio, lostAreaMm2, lengthMm } = measured;
  const { alignmentConstrained, turnBound } = measured;
  const area = Math.max(1e-6, lengthMm * spacing); // [mm²], accurate enough for a density
  const perCm2 = (count: number): number => round((100 * count) / area, 1);
  const verdicts: Verdict[] = [
    {
      measure: 'path',
      level: report.unjoined > 0 ? 'fair' : 'good',
      text: report.toolpaths === 1 ? 'path.one' : report.unjoined > 0 ? 'path.apart' : 'path.many',
      values: { n: report.toolpaths, length: round(lengthMm / 1000, 2), apart: report.unjoined },
    },
  ];
  for (const { r, contrast } of report.pictures ?? []) {
    const level = contrast < unseenContrast ? 'poor' : levelBetween(r, 0.9, 0.7, false);
    verdicts.push(judged('picture', level, { percent: round(100 * Math.max(0, r), 0), contrast: round(contrast, 1) }));
  }
  if (crossings > 0) verdicts.push(judged('crossings', 'poor', { n: crossings }));
  verdicts.push(
    judged('coverage', levelBetween(coverage, 98.5, 96, false), { percent: round(coverage, 1) }),
    judged('overlap', levelBetween(overlap, 1.5, 4, true), { percent: round(overlap, 1) }),
  );

  if (alignmentConstrained === 0) {
    verdicts.push({ measure: 'alignment', level: 'good', text: 'alignment.free', values: {} });
  } else {
    // An alignment of -1 is perfect, -0.5 what chance gives.
    const percent = Math.max(0, (-alignmentConstrained - 0.5) * 200);
    verdicts.push(judged('alignment', levelBetween(percent, 90, 70, false), { percent: round(percent, 1) }));
  }

  const turning = { n: uTurns, density: perCm2(uTurns), bound: turnBound };
  const widths = {
    low: round(width.p01 * spacing, 2),
    high: round(width.p99 * spacing, 2),
    median: round(width.median * spacing, 2),
    percent: round(100 * width.clamped, 1),
  };
  const filled = fillRatio >= 0.97 && fillRatio <= 1.05 ? 'good' : 'fair';
  const lostShare = (100 * lostAreaMm2) / area;
  const lost = lostAreaMm2 < 0.005 ? 'good' : lostShare < 1 ? 'fair' : 'poor';
  const turns = levelBetween(perCm2(uTurns), 6, 15, true);
  // If no path could turn less often, the directions are the cause and not the path.
  const needed = turns !== 'good' && uTurns <= turnBound;
  verdicts.push(
    needed
      ? { measure: 'uTurns', level: 'fair', text: 'uTurns.needed', values: turning }
      : judged('uTurns', turns, turning),
    judged('kinks', perCm2(kinks) <= 0.2 ? 'good' : 'fair', { n: kinks }),
    judged('widths', levelBetween(width.clamped, 0.01, 0.05, true), widths),
    judged('fill', filled, { percent: round(100 * fillRatio, 1) }),
    judged('lost', lost, { area: round(lostAreaMm2, 2), percent: round(lostShare, 1) }),
  );
  return verdicts;
}

const plainTop = 0.03; // share of the length laid over two minutes apart on PrusaSlicer's monotonic top of a disc of 60 mm

const mostSqueezed = 0.04; // a slicer's monotonic top has 1 to 2 %

/** Judges whether beads are laid soon after the beads beside them, and whether all lean to one side. */
export const orderVerdicts = ({ over120, squeezed }: NeighbourDelay): Verdict[] => [
  judged('order', over120 <= plainTop ? 'good' : 'fair', {
    percent: round(100 * over120, 1),
    usual: round(100 * plainTop, 0),
  }),
  judged('squeezed', squeezed <= mostSqueezed ? 'good' : 'fair', { percent: round(100 * squeezed, 1) }),
];
