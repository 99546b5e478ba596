// The list of all actions: people find what they look for by their own words, in every language, and are led to it.
import assert from 'node:assert/strict';
import { after, afterEach, before, beforeEach, test } from 'node:test';

import { skip, start } from './support/studio.js';

/** Words that people typed, and others of the same kind. */
const wanted = {
  en:
    'gcode g-code printer ender prusa bambu voron nozzle temperature text font photo picture logo QR hole size link lamp ' +
    'stl brush re-brush rebrush thickness spacing diameter width height layers border wave waves rays spiral noise mode ' +
    'comb eraser zoom undo redo language dark light compare video speed fan flow bed skirt brim rim copies filament petg ' +
    'gold spool seed bridge perimeters walls outline top bottom toolpath quality calibrate help new save project svg heart star ring disc rectangle tag zones base wifi',
  de:
    'gcode G-Code Drucker Ender Prusa Bambu Düse Temperatur Wände Perimeter Bahnabstand Druckweg Qualität Text Schrift Foto Bild Logo QR Loch Größe Link Lampe STL bürsten ' +
    'Dicke Abstand Durchmesser Breite Höhe Ebenen Wellen Strahlen Spirale Rauschen kämmen Radierer Rückgängig Sprache ' +
    'dunkel Vergleich Fluss Bett Kopien Filament PETG Gold Spule Brücke kalibrieren Hilfe Projekt SVG Herz Stern Ring ' +
    'Scheibe Rechteck Zonen WLAN Geschwindigkeit Lüfter',
  fr:
    'gcode G-code imprimante Ender Prusa Bambu buse température parois périmètres espacement trajet qualité texte police photo image logo QR trou taille lien lampe STL ' +
    'rebrosser épaisseur espacement diamètre largeur hauteur calques vagues rayons spirale bruit peigner gomme annuler ' +
    'langue sombre comparer débit plateau filament PETG bobine calibrer aide projet SVG cœur étoile anneau disque rectangle ' +
    'zones wifi vitesse ventilateur',
};

let studio, visit;
before(async () => {
  if (!skip) studio = await start();
});
after(() => studio?.close());
beforeEach(async () => {
  if (!skip) visit = await studio.open({ small: true });
});
afterEach(async ({ passed }) => {
  if (!skip) await studio.leave(visit, passed);
});

/** Opens the list, and tells how to ask it for words. */
async function opened() {
  const { page } = visit;
  await page.keyboard.press('Control+k');
  const input = page.locator('sillon-palette input');
  await input.waitFor();
  const options = page.locator('sillon-palette [role=option]');
  const ask = async (word) => {
    await input.fill(word);
    await page.evaluate(
      () => document.querySelector('sillon-app').renderRoot.querySelector('sillon-palette').updateComplete,
    );
    return options.allInnerTexts();
  };
  return { page, ask };
}

for (const [language, words] of Object.entries(wanted)) {
  test(`the words of people find actions, in ${language}`, { skip }, async () => {
    await visit.page.evaluate((name) => document.querySelector('sillon-app').studio.setLanguage(name), language);
    const { ask } = await opened();
    const lost = [];
    for (const word of words.split(' ')) if ((await ask(word)).length === 0) lost.push(word);
    assert.deepEqual(lost, []);
    assert.deepEqual(await ask('qxz'), []);
  });
}

test('what a name says comes before other words for it, and lists are not shown unasked', { skip }, async () => {
  const { ask } = await opened();
  assert.match((await ask('link'))[0], /./);
  assert.match((await ask('heart'))[0], /Heart/);
  assert.match((await ask('ender-3 v2'))[0], /Ender-3 V2/);
  const all = await ask('');
  assert.ok(all.length < 60 && !all.some((text) => /Ender|Heart/.test(text)), all.join(', '));
});

test('settings and views are found by their former names, too', { skip }, async () => {
  const { page } = visit;
  const former = {
    en: ['bead spacing: Line width', 'border mode: Outline', 'base layers: Bottom layers', 'flow: Directions'],
    de: ['Bahnabstand: Linienbreite', 'Perimeter: Wände', 'Schimmerschichten: Deckschichten'],
    fr: ['couches de base: Couches du fond', 'périmètres: Parois', 'apparence: Aspect'],
  };
  for (const [language, pairs] of Object.entries(former)) {
    await page.evaluate((name) => document.querySelector('sillon-app').studio.setLanguage(name), language);
    const { ask } = await opened();
    for (const pair of pairs) {
      const [words, name] = pair.split(': ');
      assert.ok(
        (await ask(words)).some((text) => text.endsWith(name) || text.includes(`: ${name}`)),
        pair,
      );
    }
    await page.keyboard.press('Escape');
    await visit.until((state) => state.dialog === undefined);
  }
});

test('a setting that is found gets the focus', { skip }, async () => {
  const { page, ask } = await opened();
  assert.match((await ask('nozzle temperature first'))[0], /first layer/i);
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => {
    let one = document.activeElement;
    while (one?.shadowRoot?.activeElement) one = one.shadowRoot.activeElement;
    return one?.id === 'printer-firstLayerNozzleTemperature';
  });
  const box = await page.locator('#printer-firstLayerNozzleTemperature').boundingBox();
  assert.ok(box.y > 0 && box.y < 600, `${box.y}`);
});

test('a body of another format is told to be sliced first, and a picture is no sliced print', { skip }, async () => {
  const { page } = visit;
  const drop = (name, text) =>
    page.evaluate(
      ([name, text]) => document.querySelector('sillon-app').studio.open([new File([text], name)]),
      [name, text],
    );
  await drop('bracket.step', 'ISO-10303-21;\nHEADER;\nENDSEC;');
  await page.getByText('bracket.step is a body, not yet sliced.').waitFor();
  const { ask } = await opened();
  assert.match((await ask('re-brush'))[0], /Re-brush a sliced print/);
  // A browser that is busy for long would show no chooser, as nobody has just pressed a key.
  await page.evaluate(() => {
    const { studio } = document.querySelector('sillon-app');
    studio.pick = () => Promise.resolve([new File([Uint8Array.of(0x89, 0x50, 0x4e, 0x47)], 'part.gcode')]);
  });
  await page.keyboard.press('Enter');
  await page.getByText('part.gcode is no sliced print.').waitFor();
  await page.evaluate(() => delete document.querySelector('sillon-app').studio.pick);
});
