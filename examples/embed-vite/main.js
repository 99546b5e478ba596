// The element is loaded from the studio's own address, so there is nothing to bundle:
//   VITE_STUDIO=https://sillon.example/ npx vite build
const studio = import.meta.env.VITE_STUDIO ?? 'https://sillon.example/';
await import(/* @vite-ignore */ `${studio}embed/sillon-studio.js`);

const element = document.createElement('sillon-studio');
element.mode = 'view';
element.addEventListener('result', ({ detail }) => {
  document.title = `${detail.report.toolpaths} toolpath, ${detail.report.points} points`;
});
document.querySelector('#app').append(element);
await element.load({
  sillon: 1,
  shape: { builtin: 'disc', size: [30, 30] },
  layers: [{ kind: 'direction', angle: 45 }],
});
