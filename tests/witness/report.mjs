// The page of a report in a browser that is not ours: headless Chromium (Debian's, else the one that CHROMIUM names) by
// playwright-core. It opens without an error in the console and without asking for anything else, its canvas is not blank, a
// click plays, the switches and the charts do what they say, in a light and a dark page, wide and narrow.
import { chromium } from 'playwright-core';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { Checks, run } from './lib.mjs';

const [model, folder] = process.argv.slice(2);
const stem = path.parse(model).name;
const checks = new Checks(`report ${stem}`);
const page = path.join(folder, `${stem}.report.html`);

try {
  run('report', model, '-o', page);
} catch (failure) {
  if (failure.status !== 3) throw failure;
  checks.fact('is refused');
  checks.end();
  process.exit();
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});

/** How many different colours the canvas shows, in a grid of points, and a sum that tells pictures apart. */
async function canvasOf(tab) {
  const png = (await tab.locator('#canvas').screenshot()).toString('base64');
  return tab.evaluate(async (bytes) => {
    const picture = await createImageBitmap(new Blob([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))], { type: 'image/png' }));
    const drawing = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
    drawing.drawImage(picture, 0, 0);
    const { data } = drawing.getImageData(0, 0, picture.width, picture.height);
    const colors = new Set();
    let sum = 0;
    for (let i = 0; i < data.length; i += 4 * 37) {
      colors.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      sum = (sum * 31 + data[i] + 3 * data[i + 1] + 7 * data[i + 2]) % 1e9;
    }
    return { colors: colors.size, sum };
  }, png);
}

async function open(options) {
  const tab = await browser.newPage(options);
  tab.setDefaultTimeout(300000);  // a busy machine without a graphics card takes its time
  const told = [];
  const asked = [];
  tab.on('console', (message) => { if (message.type() === 'error') told.push(message.text()); });
  tab.on('pageerror', (error) => told.push(String(error)));
  tab.on('request', (request) => { if (!/^(data|blob|file):/.test(request.url())) asked.push(request.url()); });
  await tab.goto(pathToFileURL(page).href);
  await tab.waitForTimeout(1500);
  return { tab, told, asked };
}

const clock = async (tab) => parseFloat(await tab.locator('#clock').textContent());

for (const [name, options] of Object.entries({
  light: { viewport: { width: 1280, height: 900 }, colorScheme: 'light' },
  dark: { viewport: { width: 1280, height: 900 }, colorScheme: 'dark' },
  narrow: { viewport: { width: 390, height: 800 }, colorScheme: 'light' },
})) {
  const { tab, told, asked } = await open(options);
  const first = await canvasOf(tab);
  checks.that(first.colors > 50, `${name}: the canvas shows ${first.colors} colours`);
  await tab.screenshot({ path: path.join(folder, `${stem}.report.${name}.png`), fullPage: true });
  if (name === 'light' && (await tab.locator('#play').isDisabled())) {
    // A doll that the doctor does not let fall is shown as it stands.
    checks.that((await tab.locator('#drops button').textContent()) === 'Bind pose', 'what can not be played is called the bind pose');
    checks.fact('shown in the bind pose');
  } else if (name === 'light') {
    await tab.click('#play');
    checks.that((await tab.locator('#play').textContent()) === 'Pause', 'the button offers a pause');
    await tab.waitForTimeout(1500);
    await tab.click('#play');
    const played = await clock(tab);
    checks.that(played > 0.2, `a click plays: the clock stands at ${played} s`);
    const later = await canvasOf(tab);
    checks.that(later.sum !== first.sum, 'the picture is another one');
    await tab.locator('#scrub').fill('1');
    await tab.locator('#scrub').dispatchEvent('input');
    checks.that(Math.abs((await clock(tab)) - 6) < 0.01, 'the slider goes to the end');
    const lying = await canvasOf(tab);
    for (const box of ['#showBodies', '#showLimits']) {
      await tab.click(box);
      await tab.waitForTimeout(300);
    }
    const opened = await canvasOf(tab);
    checks.that(opened.sum !== lying.sum, 'bodies and limits are drawn');
    await tab.locator('#view').screenshot({ path: path.join(folder, `${stem}.report.limits.png`) });
    await tab.locator('.chart').first().click({ position: { x: 200, y: 60 } });
    const clicked = await clock(tab);
    checks.that(clicked > 0.5 && clicked < 5, `a click on a chart goes to its moment: ${clicked} s`);
    await tab.click('#drops button:nth-child(3)');
    checks.that((await tab.locator('#drops button:nth-child(3)').getAttribute('aria-pressed')) === 'true', 'the third drop is chosen');
    await tab.locator('#canvas').focus();
    await tab.keyboard.press('ArrowRight');
    checks.near(await clock(tab), clicked + 1 / 30, 0.011, 'an arrow goes on by a pose');
  }
  const width = await tab.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  checks.that(width <= 0, `${name}: the page is ${width} pixels wider than the window`);
  checks.that(told.length === 0, `${name}: the console tells ${told.join('; ')}`);
  checks.that(asked.length === 0, `${name}: it asks for ${asked.join(', ')}`);
  await tab.close();
}

// A library of two, with one that is refused.
const library = path.join(folder, `${stem}.library`);
fs.rmSync(library, { recursive: true, force: true });
fs.mkdirSync(library, { recursive: true });
// With what lies beside the model under names that begin like its own: it may be a part of it.
const models = ['.glb', '.gltf', '.vrm', '.fbx', '.dae', '.bvh'];
const isOther = (name) => name !== path.basename(model) && models.includes(path.extname(name).toLowerCase());
const parts = fs.readdirSync(path.dirname(model)).filter((name) => name.startsWith(stem) && !isOther(name));
for (const name of ['a', 'b']) {
  fs.mkdirSync(path.join(library, name), { recursive: true });
  for (const part of parts) fs.copyFileSync(path.join(path.dirname(model), part), path.join(library, name, part));
}
fs.writeFileSync(path.join(library, 'broken.glb'), 'glTF');
const table = path.join(folder, `${stem}.library.html`);
run('report', library, '-o', table);
const tab = await browser.newPage({ viewport: { width: 1280, height: 700 } });
const told = [];
tab.on('console', (message) => { if (message.type() === 'error') told.push(message.text()); });
tab.on('pageerror', (error) => told.push(String(error)));
await tab.goto(pathToFileURL(table).href);
checks.that((await tab.locator('#models tbody tr').count()) === 2, 'the library has two rows');
await tab.click('#models th:first-child');
await tab.click('#models th:first-child');
checks.that((await tab.locator('#models tbody tr').first().textContent()).startsWith('b'), 'a click on a head sorts');
await tab.fill('#search', 'a/');
checks.that((await tab.locator('#models tbody tr:visible').count()) === 1, 'the search leaves one row');
await tab.fill('#search', '');
checks.that((await tab.locator('body').textContent()).includes('broken.glb'), 'the refused one is told');
await tab.screenshot({ path: path.join(folder, `${stem}.library.png`), fullPage: true });
checks.that(told.length === 0, `the library's console tells ${told.join('; ')}`);
await browser.close();
checks.fact(`${(fs.statSync(page).size / 1e6).toFixed(1)} MB`);
checks.end();
