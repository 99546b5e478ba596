// What of a page's controls cannot be reached.

/** Runs in the page. @param element  whose controls count; left out: all @returns what lies over what, in words */
export function overlaps(element) {
  const all = (root) =>
    [...root.querySelectorAll('*')].flatMap((one) => [one, ...(one.shadowRoot ? all(one.shadowRoot) : [])]);
  const above = (one) => one.assignedSlot ?? one.parentElement ?? one.getRootNode().host;
  /** What is seen of it: scrolled parts are not. */
  const seen = (one) => {
    let { left, top, right, bottom } = one.getBoundingClientRect();
    for (let around = one; around; around = above(around)) {
      const { overflow, clipPath, pointerEvents, position } = getComputedStyle(around);
      if (clipPath !== 'none') return undefined; // for screen readers
      if (around === one && pointerEvents === 'none') return undefined;
      if (around !== one && overflow !== 'visible') {
        const box = around.getBoundingClientRect();
        [left, top] = [Math.max(left, box.left), Math.max(top, box.top)];
        [right, bottom] = [Math.min(right, box.right), Math.min(bottom, box.bottom)];
      }
      if (position === 'fixed') break;
    }
    const width = Math.min(right, globalThis.innerWidth) - Math.max(left, 0);
    const height = Math.min(bottom, globalThis.innerHeight) - Math.max(top, 0);
    return width > 2 && height > 2 && one.checkVisibility({ visibilityProperty: true })
      ? { left, top, right, bottom, width, height }
      : undefined;
  };
  const within = (one, test) => {
    for (let around = one; around; around = above(around)) if (test(around)) return around;
    return undefined;
  };
  /** What sticks to an edge of its panel lies over what is scrolled there. */
  const sticks = (one) => within(one, (around) => getComputedStyle(around).position === 'sticky') !== undefined;
  const panel = (one) => within(one, ({ id }) => id === 'panel');
  const scrolls = (one, other) => panel(one) && panel(one) === panel(other) && sticks(one) !== sticks(other);
  const name = (one) =>
    `${one.tagName.toLowerCase()} "${(one.ariaLabel ?? one.textContent).replace(/\s+/g, ' ').trim().slice(0, 40)}"`;
  const ofNotices = (one) => one.getRootNode().host?.tagName === 'SILLON-NOTICES';
  const boxes = all(element?.shadowRoot ?? document)
    .filter((one) => one.matches('button, select, input, a[href], .notice'))
    .filter((one) => !ofNotices(one) || one.matches('.notice'))
    .flatMap((one) => {
      const box = seen(one);
      return box === undefined ? [] : [{ one, box }];
    });
  const found = boxes.flatMap(({ one, box }, k) =>
    boxes
      .slice(k + 1)
      .filter(
        ({ one: another, box: other }) =>
          !scrolls(one, another) &&
          Math.min(box.right, other.right) - Math.max(box.left, other.left) > 1 &&
          Math.min(box.bottom, other.bottom) - Math.max(box.top, other.top) > 1,
      )
      .map((other) => `${name(one)} and ${name(other.one)} overlap`),
  );
  const notices = boxes.filter(({ one }) => one.matches('.notice'));
  const { notices: words, problem } = document.querySelector('sillon-app').studio.store.state;
  if ((words.length > 0 || problem !== undefined) && !(notices[0]?.box.height >= 24)) found.push('no notice is seen');
  // Hit where it is seen: nothing lies over it that is no button itself.
  const deepest = (x, y) => {
    let hit = document.elementFromPoint(x, y);
    while (hit?.shadowRoot?.elementFromPoint(x, y)) {
      const inner = hit.shadowRoot.elementFromPoint(x, y);
      if (inner === hit) break;
      hit = inner;
    }
    return hit;
  };
  for (const { one, box } of boxes.filter(({ one }) => one.matches('button'))) {
    const hit = deepest((box.left + box.right) / 2, (box.top + box.bottom) / 2);
    if (!within(hit, (around) => around === one) && !scrolls(one, hit))
      found.push(`${name(one)} is under ${hit ? name(hit) : 'nothing'}`);
  }
  return found;
}
